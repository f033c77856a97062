#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

/// What blocks of the later controls (TNC 426/430, iTNC 530) have besides the words of a TNC 155.
namespace dripline::interpreter::tnc155 {

inline constexpr int kItncParameters = 2000;  ///< Q0 to Q1999
inline constexpr std::int32_t kLastItncLabel = 65'534;
inline constexpr std::size_t kLongestLabel = 64;  ///< its name: more than the controls take
/// The label of a block whose label has a name (ItncWords::name); run labels have it plus a
/// number.
inline constexpr std::int32_t kNameLabel = 1 << 30;

/// Q100 to Q199 are the control's own: what it knows of the tool, of probing, of the PLC.
constexpr bool is_of_control(std::int32_t parameter) {
  return parameter >= 100 && parameter <= 199;
}
enum ControlParameter : std::int32_t {
  kToolRadius = 108,
  kToolAxis = 109,
  kInchProgram = 113,
  kToolLength = 114,
  kFirstPlaneAngle = 120,  ///< A, B and C as PLANE has computed them
  kLastPlaneAngle = 122
};
constexpr bool is_plane_angle(std::int32_t parameter) {
  return parameter >= kFirstPlaneAngle && parameter <= kLastPlaneAngle;
}

enum class FormulaFunction : std::uint8_t {
  Sqrt,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Sq,
  Ln,
  Log,
  Exp,
  Neg,
  Int,
  Abs,
  Frac,
  Sgn,
  Count
};

/// One step of a formula in reverse Polish order.
struct FormulaStep {
  enum class Kind : std::uint8_t { Number, Parameter, Operator, Function };
  Kind kind = Kind::Number;
  char op = 0;  ///< + - * / ^ %, L: length of two sides, A: their angle
  FormulaFunction function = FormulaFunction::Sqrt;
  std::int32_t parameter = 0;
  double number = 0;
};
using Formula = std::vector<FormulaStep>;

/// Q200=+2 of a cycle.
struct CycleWord {
  std::int32_t parameter = 0;
  Value value;
  bool is_auto = false;   ///< FAUTO: the feed of TOOL CALL
  bool is_rapid = false;  ///< FMAX
};

/// In place of IDX: it is the value of the formula.
inline constexpr std::int32_t kIndexOfFormula = -1;

struct ItncWords {
  static constexpr std::size_t kMaxM = 4;

  void clear() {
    m_count = 0;
    is_auto_feed = false;
    retracts = retracts_to_limit = is_plane = is_polar = false;
    tool = feed = retract = delta_length = delta_radius = length = Value{};
    center_angle = arc_radius = Value{};
    name.clear();
    target.clear();
    formula.clear();
    second.clear();
    words.clear();
    ids.clear();
  }

  std::array<std::int16_t, kMaxM> m{};  ///< besides Block::m, which says how the path runs
  std::size_t m_count = 0;
  bool is_auto_feed = false;
  bool retracts = false;           ///< M140 MB: along the tool axis
  bool retracts_to_limit = false;  ///< M140 MB MAX
  bool is_plane = false;           ///< Accepted: PLANE without a tilt, which sets Q120 to Q122
  Value retract;
  Value tool;                        ///< TOOL CALL Q1
  Value feed;                        ///< of this block alone: RND, CHF, CYCL CALL POS; TOOL CALL
  Value delta_length, delta_radius;  ///< TOOL CALL: DL, DR
  Value length, center_angle;        ///< Approach, Departure: LEN, CCA
  Value arc_radius;                  ///< Approach, Departure: R; PR is Block::radius
  bool is_polar = false;             ///< Approach, Departure: PLT and the like
  std::string name;                  ///< of a program, a label, a tool, a mask
  std::string target;                ///< Print: where it goes
  Formula formula, second;           ///< Assignment; Comparison: both sides
  std::vector<CycleWord> words;      ///< CycleTable
  std::vector<std::int32_t> ids;     ///< SYSREAD: ID, NR, IDX or kIndexOfFormula; FN 15: Q
};

}  // namespace dripline::interpreter::tnc155
