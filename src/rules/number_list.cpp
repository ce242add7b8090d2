#include "rules/number_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/message_text.hpp"

namespace vspring {

std::vector<double> number_list(std::string_view list, std::size_t count,
                                const std::function<Error(const std::string&)>& malformed) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string text(list.substr(begin, end - begin));
    const auto value = nlohmann::json::parse(text, nullptr, false);
    if (!value.is_number()) throw malformed(fmt::format("\"{}\" is no number", in_one_line(text)));
    values.push_back(value.get<double>());
    begin = end + 1;
  }
  if (values.size() != count) throw malformed(fmt::format("{} numbers are needed, {} are given", count, values.size()));
  return values;
}

}  // namespace vspring
