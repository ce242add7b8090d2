#include "advice.hpp"

#include <string_view>

namespace vspring::cli {

namespace {

struct Advice {
  std::string_view words;  ///< in messages of the library
  std::string_view option;
};

constexpr Advice all_advice[] = {
    {"by a rule", "--constraints"},
    {"fix the boundary", "--fix boundary"},
    {"make it fair by itself first", "fair --fair-boundary"},
    {"fix the ends", "--fix boundary"},
    {"leave out a share", "--outliers"},
    {"leave out a larger share", "--outliers"},
    {"let only a region move", "--region"},
    {"a greater weight", "--weight"},
    {"a shorter smoothing length", "--smoothing-length"},
    {"a tolerance to stay within", "--within"},
    {"only take its noise off", "--noise auto"},
    {"allow more iterations", "--max-iterations"},
    {"allow more time", "--time-limit"},
    {"name the format", "--format"},
    {"choose columns", "--columns"},
    {"the choice of columns", "--columns"},
    {"weld within less", "--weld"},
    {"put the nodes in order", "--order"},
    {"leave the order along the curve", "--order"},
};

}  // namespace

std::string with_options(std::string message) {
  for (const Advice& advice : all_advice) {
    const std::size_t place = message.find(advice.words);
    if (place == std::string::npos) continue;
    message.insert(place + advice.words.size(), " (" + std::string(advice.option) + ")");
  }
  return message;
}

}  // namespace vspring::cli
