#include "io/xml_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/message_text.hpp"
#include "io/text_cursor.hpp"

namespace vspring {
namespace {

/// Whether a name may have this byte; all bytes of non-ASCII characters count as letters.
bool is_name_byte(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == ':' ||
         c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

bool begins_name(char c) { return is_name_byte(c) && c != '-' && c != '.' && !(c >= '0' && c <= '9'); }

std::string_view without_prefix(std::string_view name) { return name.substr(name.rfind(':') + 1); }

}  // namespace

XmlScanner::XmlScanner(const InputFile& file) : file_(file), at_(byte_order_mark_length(file.bytes)) {}

std::string_view XmlScanner::name() const { return without_prefix(open_.back().name); }

std::string_view XmlScanner::parent() const {
  return open_.size() > 1 ? without_prefix(open_[open_.size() - 2].name) : std::string_view();
}

XmlScanner::Event XmlScanner::next() {
  if (has_ended_) open_.pop_back();
  has_ended_ = is_empty_;
  if (is_empty_) {
    is_empty_ = false;
    return Event::element_ends;
  }
  for (;;) {
    const std::size_t text = at_;
    at_ = std::min(file_.bytes.find('<', at_), file_.bytes.size());
    if (open_.empty()) {
      const auto bytes = std::string_view(file_.bytes).substr(text, at_ - text);
      const auto* const stray = std::find_if_not(bytes.begin(), bytes.end(), is_space);
      if (stray != bytes.end())
        file_.refuse_line(text + static_cast<std::size_t>(stray - bytes.begin()),
                          fmt::format("{} stands outside of all elements; repair the XML",
                                      in_quotes(bytes.substr(static_cast<std::size_t>(stray - bytes.begin())))));
    }
    if (at_ == file_.bytes.size()) {
      if (!open_.empty()) {
        at_ = open_.back().begin;
        refuse_end(fmt::format("the element <{}> that begins here", in_one_line(open_.back().name)));
      }
      if (!has_element_) file_.refuse("no element is in it; choose another file");
      return Event::file_ends;
    }
    begin_ = at_;
    if (rest().starts_with("<!--")) {
      at_ += 4;
      skip_behind("-->", "a comment");
    } else if (rest().starts_with("<![CDATA[") && !open_.empty()) {
      skip_behind("]]>", "CDATA");
    } else if (rest().starts_with("<!DOCTYPE") && !has_element_) {
      skip_document_type();
    } else if (rest().starts_with("<?")) {
      skip_behind("?>", "an instruction");
    } else if (rest().starts_with("</")) {
      read_end();
      has_ended_ = true;
      return Event::element_ends;
    } else {
      read_begin();
      return Event::element_begins;
    }
  }
}

void XmlScanner::refuse_end(std::string_view what) const {
  file_.refuse_line(at_, fmt::format("the file ends within {}; it is cut off", what));
}

bool XmlScanner::skip_space() {
  const std::size_t begin = at_;
  while (at_ < file_.bytes.size() && is_space(file_.bytes[at_])) ++at_;
  return at_ > begin;
}

void XmlScanner::skip_behind(std::string_view end, std::string_view what) {
  const std::size_t found = file_.bytes.find(end, at_);
  if (found == std::string::npos) refuse_end(what);
  at_ = found + end.size();
}

void XmlScanner::skip_document_type() {
  const std::size_t close = file_.bytes.find_first_of("[>", at_);
  if (close != std::string::npos && file_.bytes[close] == '[')
    file_.refuse_line(at_, "the document type declares names of its own; remove them");
  skip_behind(">", "the document type");
}

std::string_view XmlScanner::read_name(std::string_view what) {
  const std::size_t begin = at_;
  if (at_ < file_.bytes.size() && !begins_name(file_.bytes[at_]))
    file_.refuse_line(at_, fmt::format("{} stands where {} belongs; repair the XML",
                                       in_quotes(std::string_view(file_.bytes).substr(at_, 1)), what));
  while (at_ < file_.bytes.size() && is_name_byte(file_.bytes[at_])) ++at_;
  if (at_ == file_.bytes.size()) refuse_end("a tag");
  return std::string_view(file_.bytes).substr(begin, at_ - begin);
}

void XmlScanner::read_attribute() {
  const std::size_t begin = at_;
  const std::string_view name = read_name("the name of an attribute");
  (void)skip_space();
  if (!rest().starts_with('='))
    file_.refuse_line(begin, fmt::format("the attribute {} has no value; repair the XML", in_quotes(name)));
  ++at_;
  (void)skip_space();
  const char quote = at_ < file_.bytes.size() ? file_.bytes[at_] : '\0';
  if (quote != '"' && quote != '\'')
    file_.refuse_line(begin, fmt::format("the value of {} is not in quotes; repair the XML", in_quotes(name)));
  const std::size_t value = ++at_;
  at_ = file_.bytes.find_first_of(std::string{quote, '<'}, at_);
  if (at_ == std::string::npos || file_.bytes[at_] == '<')
    file_.refuse_line(begin, fmt::format("the value of {} has no closing quote; repair the XML", in_quotes(name)));
  if (std::any_of(attributes_.begin(), attributes_.end(), [&](const Attribute& other) { return other.name == name; }))
    file_.refuse_line(begin, fmt::format("the attribute {} stands twice; remove one", in_quotes(name)));
  constexpr std::size_t most = 1000;
  if (attributes_.size() == most) file_.refuse_line(begin, "an element has more than 1000 attributes; split it");
  attributes_.push_back({name, std::string_view(file_.bytes).substr(value, at_ - value)});
  ++at_;
}

void XmlScanner::read_begin() {
  if (open_.empty() && has_element_) file_.refuse_line(at_, "a second outermost element begins; split the file");
  ++at_;
  const std::string_view name = read_name("the name of an element");
  open_.push_back({name, begin_});
  has_element_ = true;
  attributes_.clear();
  for (;;) {
    const bool apart = skip_space();
    if (rest().starts_with('>')) {
      ++at_;
      return;
    }
    if (rest().starts_with("/>")) {
      at_ += 2;
      is_empty_ = true;
      return;
    }
    if (at_ == file_.bytes.size()) refuse_end("a tag");
    if (!apart)
      file_.refuse_line(at_, fmt::format("{} follows without a blank; repair the XML",
                                         in_quotes(std::string_view(file_.bytes).substr(at_, 1))));
    read_attribute();
  }
}

void XmlScanner::read_end() {
  at_ += 2;
  const std::string_view name = read_name("the name of an element");
  (void)skip_space();
  if (at_ == file_.bytes.size()) refuse_end("a tag");
  if (!rest().starts_with('>'))
    file_.refuse_line(at_, fmt::format("{} stands where > ends </{}>; repair the XML",
                                       in_quotes(std::string_view(file_.bytes).substr(at_, 1)), in_one_line(name)));
  ++at_;
  if (open_.empty() || open_.back().name != name)
    file_.refuse_line(begin_,
                      fmt::format("</{}> ends an element that is not open{}; repair the XML", in_one_line(name),
                                  open_.empty() ? "" : fmt::format(", <{}> is", in_one_line(open_.back().name))));
  begin_ = open_.back().begin;
}

}  // namespace vspring
