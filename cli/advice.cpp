#include "advice.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace vspring::cli {

namespace {

/// Empty where no option does it.
std::string_view option_of(Remedy remedy) {
  switch (remedy) {
    case Remedy::input:
      return "";
    case Remedy::rules:
      return "--constraints";
    case Remedy::fix_boundary:
      return "--fix boundary";
    case Remedy::fair_boundary:
      return "fair --fair-boundary";
    case Remedy::region:
      return "--region";
    case Remedy::noise:
      return "--noise auto";
    case Remedy::within:
      return "--within";
    case Remedy::weight:
      return "--weight";
    case Remedy::smoothing_length:
      return "--smoothing-length";
    case Remedy::moving_axes:
      return "--move";
    case Remedy::outliers:
      return "--outliers";
    case Remedy::method:
      return "--method";
    case Remedy::iterations:
      return "--max-iterations";
    case Remedy::time:
      return "--time-limit";
    case Remedy::format:
      return "--format";
    case Remedy::columns:
      return "--columns";
    case Remedy::order:
      return "--order";
    case Remedy::weld:
      return "--weld";
    case Remedy::join:
      return "--join";
  }
  return "";
}

std::string with_options(const std::string& fault, std::span<const Advice> advice) {
  std::vector<Advice> told(advice.begin(), advice.end());
  for (Advice& one : told) {
    const std::string_view option = option_of(one.remedy);
    if (!option.empty()) one.words += " (" + std::string(option) + ")";
  }
  return with_advice(fault, told);
}

}  // namespace

std::string with_options(const Error& error) { return with_options(error.fault(), error.advice()); }

std::string with_options(const Warning& warning) { return with_options(warning.fault(), warning.advice); }

}  // namespace vspring::cli
