#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

/// What blocks of the later controls (TNC 426/430, iTNC 530) have besides the words of a TNC 155.
namespace dripline::interpreter::tnc155 {

inline constexpr int kItncParameters = 2000;  ///< Q0 to Q1999
/// QL0 to QL499, local to a program, and QR0 to QR499, which the control keeps; they follow Q1999
/// (iTNC 530, User's Manual, "Programming: Q parameters").
inline constexpr int kLocalParameters = 500, kRetainedParameters = 500;
inline constexpr int kFirstLocal = kItncParameters, kFirstRetained = kFirstLocal + kLocalParameters;
inline constexpr int kAllParameters = kFirstRetained + kRetainedParameters;
/// Q5, QL5, QR5.
std::string parameter_name(std::int32_t parameter);
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

/// How a PLANE gives its plane, and what the rotary axes do (iTNC 530, User's Manual, chapter
/// "Programming: multiple axis machining", the PLANE function).
enum class PlaneForm : std::uint8_t { Reset, Spatial, Euler, Vector, Relative };
enum class PlaneTurn : std::uint8_t { Stay, Turn, Move };
struct PlaneWords {
  PlaneForm form = PlaneForm::Reset;
  PlaneTurn turn = PlaneTurn::Stay;
  std::int8_t sequence = 0;  ///< SEQ+, SEQ-
  bool rotates_table = false, rotates_coordinates = false;
  bool is_text_flat = false;  ///< three spatial angles that are written as 0
  std::uint8_t axis = 0;      ///< Relative: about X, Y or Z
  std::array<Formula, 6> values;

  void clear() { *this = PlaneWords{}; }
};

/// M128 or FUNCTION TCPM, and what ends it.
enum class TipWords : std::uint8_t { None, Begin, End };

/// In place of IDX: it is the value of the formula.
inline constexpr std::int32_t kIndexOfFormula = -1;

struct ItncWords {
  static constexpr std::size_t kMaxM = 4;

  void clear() {
    m_count = 0;
    is_auto_feed = false;
    retracts = retracts_to_limit = is_polar = false;
    tool = feed = retract = delta_length = delta_radius = length = Value{};
    center_angle = arc_radius = Value{};
    name.clear();
    target.clear();
    formula.clear();
    second.clear();
    words.clear();
    ids.clear();
    tip = TipWords::None;
    retained.clear();
    if (block_has_plane) plane.clear();
    block_has_plane = false;
  }

  std::array<std::int16_t, kMaxM> m{};  ///< besides Block::m, which says how the path runs
  std::size_t m_count = 0;
  bool is_auto_feed = false;
  bool retracts = false;           ///< M140 MB: along the tool axis
  bool retracts_to_limit = false;  ///< M140 MB MAX
  Value retract;
  Value tool;                          ///< TOOL CALL Q1
  Value feed;                          ///< of this block alone: RND, CHF, CYCL CALL POS; TOOL CALL
  Value delta_length, delta_radius;    ///< TOOL CALL: DL, DR
  Value length, center_angle;          ///< Approach, Departure: LEN, CCA
  Value arc_radius;                    ///< Approach, Departure: R; PR is Block::radius
  bool is_polar = false;               ///< Approach, Departure: PLT and the like
  std::string name;                    ///< of a program, a label, a tool, a mask
  std::string target;                  ///< Print: where it goes
  Formula formula, second;             ///< Assignment; Comparison: both sides
  std::vector<CycleWord> words;        ///< CycleTable
  std::vector<std::int32_t> retained;  ///< QR parameters that are values of words
  PlaneWords plane;                    ///< Plane
  bool block_has_plane = false;
  TipWords tip = TipWords::None;  ///< of any block with M functions; TipControl
  std::vector<std::int32_t> ids;  ///< SYSREAD: ID, NR, IDX or kIndexOfFormula; FN 15: Q
};

}  // namespace dripline::interpreter::tnc155
