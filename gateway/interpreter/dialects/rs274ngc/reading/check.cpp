#include "gateway/interpreter/dialects/rs274ngc/reading/block_reader.hpp"

#include <fmt/core.h>
#include <cmath>

namespace dripline::interpreter::rs274ngc {
namespace {

struct UnusedWord {
  char letter;
  DiagnosticRow code;
};
constexpr std::array kWordsWithUsers{
    UnusedWord{'D', ErrorCode::UnusedD}, UnusedWord{'E', ErrorCode::UnusedE},
    UnusedWord{'H', ErrorCode::UnusedH}, UnusedWord{'I', ErrorCode::UnusedI},
    UnusedWord{'J', ErrorCode::UnusedJ}, UnusedWord{'K', ErrorCode::UnusedK},
    UnusedWord{'L', ErrorCode::UnusedL}, UnusedWord{'P', ErrorCode::UnusedP},
    UnusedWord{'Q', ErrorCode::UnusedQ}, UnusedWord{'R', ErrorCode::UnusedR}};
constexpr AddressSet kNeedUser = set_of("DEHIJKLPQR");

bool check_unused(Run& run, AddressSet taken) {
  const Words& words = run.block.words;
  for (const UnusedWord& each : kWordsWithUsers) {
    if (words.has(each.letter) && (taken & set_of(each.letter)) == 0) {
      return run.fail_word(each.code, each.letter,
                           fmt::format("{}{}", each.letter, words[each.letter]));
    }
  }
  return true;
}

/// A motion code of the line itself.
bool decide_explicit(Run& run, int code, bool has_axes) {
  Block& block = run.block;
  if (code == 800) {
    if (has_axes && block.axis_user == nullptr) return run.fail(ErrorCode::AxisWithG80, 0);
    if (!has_axes && block.g(GGroup::OneShot) == 920) {
      return run.fail(ErrorCode::AllAxesMissingG92, 0);
    }
    block.motion = code;
    return true;
  }
  if (block.axis_user != nullptr) {
    return run.fail(ErrorCode::AxisTwice, 0,
                    fmt::format("G{} and G{}", block.axis_user->code / 10.0, code / 10.0));
  }
  const bool may_stand_alone = run.is_linuxcnc() && !is_cycle(code) && !is_probe(code);
  if (!has_axes && !may_stand_alone) {
    return run.fail(ErrorCode::AllAxesMissingMotion, 0, fmt::format("G{}", code / 10.0));
  }
  block.motion = code;
  return true;
}

bool decide_motion(Run& run) {
  Block& block = run.block;
  const bool has_polar = block.words.has_any(kPolarWords);
  const bool has_axes = block.words.has_any(kAxisWords) || has_polar;
  if (block.has(GGroup::Motion)) return decide_explicit(run, block.g(GGroup::Motion), has_axes);
  if (block.axis_user != nullptr) {
    const int code = block.axis_user->code;
    if (!has_axes && (code == 920 || code == 520)) return run.fail(ErrorCode::AllAxesMissingG92, 0);
    return true;
  }
  if (!has_axes) return true;
  const int modal = run.state.modes.motion;
  if (modal == 800) return run.fail(ErrorCode::AxisWithoutG, 0);
  block.motion = modal;
  return true;
}

bool check_one_shot(Run& run) {
  const Block& block = run.block;
  if (block.g(GGroup::OneShot) == 40) {
    if (!block.words.has('P') || block.words['P'] < 0) {
      return run.fail_word(ErrorCode::MissingG4P, 'P');
    }
    return true;
  }
  if (block.g(GGroup::OneShot) != 530) return true;
  if (block.motion != 0 && block.motion != 10) return run.fail(ErrorCode::G53Motion, 0);
  const bool is_incremental = block.has(GGroup::Distance) ? block.g(GGroup::Distance) == 910
                                                          : run.state.modes.is_incremental;
  if (is_incremental) return run.fail(ErrorCode::G53Incremental, 0);
  return true;
}

/// LinuxCNC refuses a P above a whole number, up to its half; a system needs one, 0 is that in
/// force. Tools are checked where their rows are written.
bool check_g10_number(Run& run) {
  const Words& words = run.block.words;
  const double l = words.value_or('L', -1);
  const double p = words.value_or('P', -1);
  const double whole = std::round(p);
  if (p - whole > 0.0001) return run.fail_word(ErrorCode::G10PInteger, 'P');
  if ((l != 2 && l != 20) || (whole >= 0 && whole <= kSystems)) return true;
  return run.fail_word(
      ErrorCode::G10PRange, 'P',
      words.has('P') ? fmt::format("P{} is not in 0 to 9", p) : fmt::format("G10 L{} needs P", l));
}

/// G10 of the NIST program knows L2 only.
bool check_g10(Run& run) {
  const Words& words = run.block.words;
  if (run.is_linuxcnc()) return check_g10_number(run);
  if (!words.has('L') || words['L'] != 2) return run.fail_word(ErrorCode::G10L, 'L');
  const double p = words.value_or('P', 0);
  const double whole = std::round(p);
  if (!(std::fabs(p - whole) <= 0.0001)) return run.fail_word(ErrorCode::G10PInteger, 'P');
  if (!(whole >= 1 && whole <= kSystems)) return run.fail_word(ErrorCode::G10PRange, 'P');
  return true;
}

}  // namespace

bool check_line(Run& run) {
  if (!decide_motion(run)) return false;
  const Block& block = run.block;
  if (block.words.has_any(kNeedUser & ~block.words_taken)) {
    AddressSet taken = block.words_taken;
    if (block.motion >= 0) {
      taken |= words_of(*g_row(block.motion, run.options.profile), run.options.profile);
    }
    if (!check_unused(run, taken)) return false;
  }
  if (!block.has(GGroup::OneShot)) [[likely]]
    return true;
  if (block.g(GGroup::OneShot) == 100 && !check_g10(run)) return false;
  return check_one_shot(run);
}

}  // namespace dripline::interpreter::rs274ngc
