#pragma once

#include <string>

#include "clients/tools/conversational/post.hpp"
#include "clients/tools/conversational/reader.hpp"

namespace dripline::conversational {

/// `body` between a set-up in inches, as event 0, and an end that posts nothing.
inline std::string file_of(const std::string& body) {
  return "[[event]]\ntype = \"program_setup\"\nprogram = 7\n" + body +
         "\n[[event]]\ntype = \"end_of_program\"\nspindle_off = \"no\"\ncoolant_off = \"no\"\n";
}

/// What the events of `body` post, or the error.
inline std::string posted(const std::string& body, const PostOptions& options = {}) {
  const auto events = read_events(file_of(body));
  if (!events) return "error: " + events.error().what;
  const auto text = post(*events, options);
  if (!text) return "error: " + text.error().what;
  const std::string head = "O0007\nG20 G93\n";
  return text->starts_with(head) ? text->substr(head.size()) : "no head: " + *text;
}

/// One event of this type with these fields.
inline std::string event(const std::string& type, const std::string& fields) {
  return "[[event]]\ntype = \"" + type + "\"\n" + fields + "\n";
}

}  // namespace dripline::conversational
