#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gateway/interpreter/core/language/expression.hpp"
#include "gateway/interpreter/core/program_source.hpp"

/// What expressions compute, so that those of a loop are read once and from then on computed alone.
namespace dripline::interpreter::rs274ngc {

struct Run;
enum class Function : std::uint8_t;

/// The arithmetic of RS274/NGC.
language::Computed computed(language::Operator op, double left, double right);
/// Of the point (x, y), in degrees.
double angle_of(double y, double x);

/// The steps of one expression, in the order in which they are computed: values are put on a stack,
/// the others replace those on top by what they give. Only what depends on nothing but parameters
/// of the control's memory: names, signals and computed indexes are read each time.
class KnownExpression {
 public:
  static constexpr std::size_t kMaxSteps = 12;
  struct Step {
    enum class Kind : std::uint8_t { Constant, Parameter, Negate, Operate, Compute, ArcTangent };
    Kind kind = Kind::Constant;
    language::Operator op = language::Operator::None;
    Function function{};
    std::uint16_t parameter = 0;
    double value = 0;
  };

  void add(const Step& step) {
    if (count_ < kMaxSteps) {
      steps_[count_++] = step;
    } else {
      spoil();
    }
  }
  /// It has something that is not kept.
  void spoil() { is_spoiled_ = true; }
  bool is_good() const { return !is_spoiled_; }
  std::span<const Step> steps() const { return {steps_.data(), count_}; }

 private:
  std::array<Step, kMaxSteps> steps_;
  std::uint8_t count_ = 0;
  bool is_spoiled_ = false;
};

/// False where one of the steps has no result; the run may have an alarm then.
bool compute_steps(Run& run, const KnownExpression& known, double& value);

/// The expressions of the places in the text that were read last. Only a cache.
class KnownExpressions {
 public:
  struct Slot {
    std::uint64_t offset = 0;
    ProgramIndex program = kMainProgram;
    std::uint32_t length = 0;  ///< of its text; 0: nothing is known
    KnownExpression expression;
  };

  /// The one at this place, or nothing.
  const Slot* find(ProgramIndex program, std::uint64_t offset) const {
    if (slots_.empty()) return nullptr;
    const Slot& slot = slots_[offset % kSlots];
    return slot.length != 0 && slot.offset == offset && slot.program == program ? &slot : nullptr;
  }
  void keep(const Slot& slot) {
    if (slots_.empty()) slots_.resize(kSlots);
    slots_[slot.offset % kSlots] = slot;
  }
  void clear() { slots_.clear(); }

 private:
  static constexpr std::size_t kSlots = 256;
  std::vector<Slot> slots_;  ///< none before the first
};

}  // namespace dripline::interpreter::rs274ngc
