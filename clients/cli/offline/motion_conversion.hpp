#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/offline_program.hpp"

namespace dripline::cli {

/// `dnc convert --to CONTROL`: a program written for another control from its motion, and proved by
/// comparing the motion of both.
struct MotionConversion {
  OfflineCommand source;
  std::string output;  ///< a file; `-` writes to standard output
  std::string to;      ///< a target of clients/tools/post
  std::string target_setup;
  std::string units;  ///< mm, in; empty: those of the source
  std::optional<std::uint64_t> name;
  std::optional<double> tolerance, chord;
  bool is_as_set_up = false, keeps_compensation = false;
};

/// The names that `--to` takes.
std::vector<std::string> motion_targets();
bool is_motion_target(std::string_view name);

/// --control, --to-setup, --units, --name, --tolerance, --arcs-as-lines, --as-set-up and
/// --keep-compensation.
void add_motion_options(Command command, MotionConversion& options);
/// The first of them that was given; empty: none.
std::string given_motion_option(const Command& command);

/// Returns the exit status; prints the reason of a failure on standard error. A file that is not
/// proved is not there afterwards.
int convert_by_motion(Context& context, const MotionConversion& command);

}  // namespace dripline::cli
