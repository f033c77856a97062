#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/context.hpp"

namespace CLI {
class App;
}  // namespace CLI

/// What a shell offers when Tab is pressed in a `dnc` command. The script of a shell is a few lines
/// that ask `dnc completion words WORD...`; so the verbs are always those of this `dnc`, and names
/// of programs, machines, ports and runs are those of the server.
namespace dripline::cli {

/// What may be typed in the place of a word.
struct Candidates {
  enum class Names : std::uint8_t { None, Files, Programs, Machines, Ports, Runs, Controls };
  std::vector<std::string> words;  ///< verbs, options, fixed values
  Names names = Names::None;       ///< besides them
};

/// Of the last of `words`, which may be empty; the others precede it, without the program's name.
/// Pure: nothing is parsed into the application.
Candidates candidates_of(const CLI::App& app, std::span<const std::string> words);

/// `dnc completion words WORD...`: prints what may be typed, a candidate a line; `:files` alone:
/// names of files. The connection's options are read from the words. Ends after a second at most,
/// whatever the server does. Returns the exit status.
int print_candidates(const CLI::App& app, Context& context, std::span<const std::string> words);

/// Adds `dnc completion bash|zsh|fish`, which prints the script.
void add_completion_command(Command app, Context& context);

}  // namespace dripline::cli
