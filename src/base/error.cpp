#include "vspring/error.hpp"

#include <utility>

namespace vspring {

std::string with_advice(const std::string& fault, std::span<const Advice> advice) {
  std::string text = fault;
  for (std::size_t k = 0; k < advice.size(); ++k) {
    text += k == 0 ? "; " : k + 1 < advice.size() ? ", " : ", or ";
    text += advice[k].words;
  }
  return text;
}

Error::Error(ErrorCode code, const std::string& fault, std::vector<Advice> advice)
    : std::runtime_error(with_advice(fault, advice)),
      code_(code),
      advice_(std::make_shared<const std::vector<Advice>>(std::move(advice))) {}

std::string Error::fault() const {
  const std::string text = what();
  return text.substr(0, text.size() - with_advice("", *advice_).size());
}

std::span<const Advice> Error::advice() const noexcept { return *advice_; }

}  // namespace vspring
