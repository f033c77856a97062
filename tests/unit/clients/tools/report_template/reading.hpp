#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "clients/tools/report_template/report_interpreter.hpp"

namespace dripline::report_template {

/// A template that must be good.
inline std::shared_ptr<const ReportTemplate> made(std::string_view toml) {
  auto read = read_template(toml);
  EXPECT_TRUE(read) << (read ? "" : read.error().what);
  return std::make_shared<const ReportTemplate>(read ? *std::move(read) : ReportTemplate{});
}

inline std::string file_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_FALSE(text.str().empty()) << path;
  return text.str();
}

/// What lines brought, as short texts: `D12=40.018 scrap`, `doubled: ...`, `[`, `] good`.
class Reading {
 public:
  explicit Reading(std::string_view toml) : interpreter_(made(toml)) {}

  Reading& take(std::string_view text, std::string_view kind = "output") {
    const auto taken = interpreter_.take({.text = text, .kind = kind});
    add(taken.events);
    if (!taken.is_understood && interpreter_.is_for({.text = text, .kind = kind}))
      brought.push_back("? " + std::string(text));
    return *this;
  }
  Reading& end() {
    add(interpreter_.end());
    return *this;
  }
  const ReportInterpreter& interpreter() const { return interpreter_; }

  std::vector<std::string> brought;
  std::vector<Value> values;

 private:
  void add(const std::vector<ReportEvent>& events) {
    for (const auto& event : events) {
      if (const auto* value = std::get_if<Value>(&event)) {
        values.push_back(*value);
        brought.push_back(fmt::format("{}={:.{}f} {}", value->characteristic.name, value->actual,
                                      value->characteristic.decimals,
                                      measurement::to_string(value->verdict)));
      } else if (const auto* finding = std::get_if<Finding>(&event)) {
        brought.push_back(fmt::format("{}: {}", to_string(finding->kind), finding->text));
      } else if (const auto* ended = std::get_if<PartEnded>(&event)) {
        brought.push_back(fmt::format("] {}", measurement::to_string(ended->part.verdict)));
      } else {
        brought.emplace_back("[");
      }
    }
  }

  ReportInterpreter interpreter_;
};

using Brought = std::vector<std::string>;

}  // namespace dripline::report_template
