#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/setup.hpp"

namespace dripline::post {

/// The cutter compensation of a program that is written as it is programmed, and not as its path.
struct KeptCompensation {
  /// Of a block and those after it.
  struct State {
    std::uint64_t block = 0;  ///< the ordinal of `Origin`
    interpreter::CompensationSide side = interpreter::CompensationSide::Off;
    int number = 0;  ///< of the radius: D, or the tool's
  };
  std::vector<State> states;    ///< in the order of blocks, each another one
  std::map<int, double> radii;  ///< mm, by their numbers

  bool is_used() const { return !radii.empty(); }
  State at(std::uint64_t block) const;
};

/// Multiplied with the radii, for the second proof. Smaller, so that what a tool can cut stays so.
inline constexpr double kOtherRadius = 0.75;

/// With all radii of its tools times `factor`.
interpreter::Setup scaled_radii(interpreter::Setup setup, double factor);
/// With radii by which their numbers are known, and which move nothing: a program runs as it is
/// programmed.
interpreter::Setup marked_radii(interpreter::Setup setup);
/// The number of a marked radius; 0: it is none.
int number_of_mark(double radius);

/// Text of a HEIDENHAIN control whose TOOL DEF (G99) has radii, with these times `factor`.
std::string scaled_definitions(std::string_view text, double factor);

/// A source whose main program is another text.
class ReplacedSource final : public interpreter::ProgramSource {
 public:
  /// `rest` must outlive it: programs that are called.
  ReplacedSource(interpreter::ProgramSource& rest, std::string text)
      : rest_(rest), text_(std::move(text)), main_(text_) {}
  ReplacedSource(const ReplacedSource&) = delete;
  ReplacedSource& operator=(const ReplacedSource&) = delete;

  std::string_view text() const { return text_; }
  interpreter::TextWindow fetch(interpreter::ProgramIndex program, std::uint64_t offset,
                                std::size_t min_bytes) override {
    return program == interpreter::kMainProgram ? main_.fetch(program, offset, min_bytes)
                                                : rest_.fetch(program, offset, min_bytes);
  }
  interpreter::ProgramLookup find(std::string_view name) override { return rest_.find(name); }

 private:
  interpreter::ProgramSource& rest_;
  std::string text_;
  interpreter::MemorySource main_;
};

}  // namespace dripline::post
