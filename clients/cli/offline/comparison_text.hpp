#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace dripline::cli {

struct ComparedNames {
  std::string first, second;  ///< files, or revisions of programs
};

/// The result of a comparison (clients/tools/comparison/README.md) for people: a unified listing of
/// the text, or the list of places where the motion differs.
std::string comparison_text(const nlohmann::ordered_json& result, const ComparedNames& names,
                            bool has_color);

/// Of the result: 0 the same, 1 not.
int comparison_status(const nlohmann::ordered_json& result);

}  // namespace dripline::cli
