#pragma once

#include <string_view>

#include "gateway/interpreter/core/event.hpp"

/// What this control calls an error. The texts are the reference interpreter's, without what they
/// name; NGC0217 is its error 217 where it has one.
namespace dripline::interpreter::rs274ngc {

// The rows are named as enumerators are, because they are used as such.
// NOLINTBEGIN(readability-identifier-naming): a row is named as an enumerator would be
struct ErrorCode {
  static constexpr DiagnosticRow BadCharacter{"NGC0100", "Bad character used"};
  static constexpr DiagnosticRow CommandTooLong{"NGC0101", "Command too long"};
  static constexpr DiagnosticRow NestedComment{"NGC0102", "Nested comment found"};
  static constexpr DiagnosticRow UnclosedComment{"NGC0103", "Unclosed comment found"};
  static constexpr DiagnosticRow NoValue{"NGC0104", "No characters found in reading real value"};
  static constexpr DiagnosticRow NoDigits{"NGC0105", "No digits found where real number should be"};
  static constexpr DiagnosticRow BadNumber{"NGC0106", "Bad number format"};
  static constexpr DiagnosticRow BadUnsigned{"NGC0107", "Bad format unsigned integer"};
  static constexpr DiagnosticRow NotInteger{"NGC0108", "Non integer value for integer"};
  static constexpr DiagnosticRow LineNumberRange{"NGC0109", "Line number greater than 99999"};
  static constexpr DiagnosticRow DuplicateWord{"NGC0110",
                                               "Multiple words of one letter on one line"};
  static constexpr DiagnosticRow EqualSign{"NGC0111", "Equal sign missing in parameter setting"};
  static constexpr DiagnosticRow ParameterRange{"NGC0112", "Parameter number out of range"};
  static constexpr DiagnosticRow ParameterReadonly{"NGC0113", "Parameter is readonly"};
  static constexpr DiagnosticRow TooManySettings{"NGC0114", "Too many parameter settings on line"};
  static constexpr DiagnosticRow NoPercent{"NGC0115", "File ended with no percent sign"};
  static constexpr DiagnosticRow NoEnd{"NGC0116", "File ended with no percent sign or program end"};
  static constexpr DiagnosticRow TextFailed{"NGC0117", "Program text cannot be read"};
  static constexpr DiagnosticRow NestedTooDeep{"NGC0118", "Expression nested too deep"};
  static constexpr DiagnosticRow DivideByZero{"NGC0120", "Attempt to divide by zero"};
  static constexpr DiagnosticRow NegativePower{"NGC0121",
                                               "Attempt to raise negative to non integer power"};
  static constexpr DiagnosticRow AcosRange{"NGC0122", "Argument to acos out of range"};
  static constexpr DiagnosticRow AsinRange{"NGC0123", "Argument to asin out of range"};
  static constexpr DiagnosticRow AtanBracket{"NGC0124",
                                             "Left bracket missing after slash with atan"};
  static constexpr DiagnosticRow AtanSlash{"NGC0125", "Slash missing after first atan argument"};
  static constexpr DiagnosticRow FunctionBracket{"NGC0126",
                                                 "Left bracket missing after unary operation name"};
  static constexpr DiagnosticRow NegativeSqrt{"NGC0127", "Negative argument to sqrt"};
  static constexpr DiagnosticRow LnZero{"NGC0128", "Zero or negative argument to ln"};
  static constexpr DiagnosticRow UnclosedExpression{"NGC0129", "Unclosed expression"};
  static constexpr DiagnosticRow UnknownOperation{"NGC0130", "Unknown operation"};
  static constexpr DiagnosticRow UnknownFunction{"NGC0131",
                                                 "Unknown word where unary operation could be"};
  static constexpr DiagnosticRow NotFinite{"NGC0132", "Value is not a finite number"};
  static constexpr DiagnosticRow NotDefined{"NGC0133", "Named parameter not defined"};
  static constexpr DiagnosticRow NotAParameter{"NGC0134", "EXISTS needs a parameter"};
  static constexpr DiagnosticRow TooManyNames{"NGC0135", "Too many named parameters"};
  static constexpr DiagnosticRow NoSignal{"NGC0136", "HAL pin cannot be read"};
  static constexpr DiagnosticRow GRange{"NGC0150", "G code out of range"};
  static constexpr DiagnosticRow GNegative{"NGC0151", "Negative g code used"};
  static constexpr DiagnosticRow GUnknown{"NGC0152", "Unknown g code used"};
  static constexpr DiagnosticRow GGroup{"NGC0153", "Two g codes used from same modal group"};
  static constexpr DiagnosticRow MRange{"NGC0154", "M code greater than 99"};
  static constexpr DiagnosticRow MNegative{"NGC0155", "Negative m code used"};
  static constexpr DiagnosticRow MUnknown{"NGC0156", "Unknown m code used"};
  static constexpr DiagnosticRow MGroup{"NGC0157", "Two m codes used from same modal group"};
  static constexpr DiagnosticRow MMany{"NGC0158", "Too many m codes on line"};
  static constexpr DiagnosticRow AxisTwice{"NGC0160",
                                           "Cannot use two g codes that both use axis values"};
  static constexpr DiagnosticRow AxisWithG80{"NGC0161", "Cannot use axis values with g80"};
  static constexpr DiagnosticRow AxisWithoutG{
      "NGC0162", "Cannot use axis values without a g code that uses them"};
  static constexpr DiagnosticRow AllAxesMissingMotion{"NGC0163",
                                                      "All axes missing with motion code"};
  static constexpr DiagnosticRow AllAxesMissingG92{"NGC0164", "All axes missing with g92"};
  static constexpr DiagnosticRow NoSuchAxis{
      "NGC0165", "Cannot use a word of an axis this machine does not have"};
  static constexpr DiagnosticRow UnusedD{"NGC0170", "D word with no g41 or g42"};
  static constexpr DiagnosticRow UnusedE{"NGC0171", "E word with no g code that uses it"};
  static constexpr DiagnosticRow UnusedH{"NGC0172", "H word with no g43"};
  static constexpr DiagnosticRow UnusedI{"NGC0173", "I word with no g2 or g3 or g87 to use it"};
  static constexpr DiagnosticRow UnusedJ{"NGC0174", "J word with no g2 or g3 or g87 to use it"};
  static constexpr DiagnosticRow UnusedK{"NGC0175", "K word with no g2 or g3 or g87 to use it"};
  static constexpr DiagnosticRow UnusedL{"NGC0176", "L word with no canned cycle or g10"};
  static constexpr DiagnosticRow UnusedP{"NGC0177", "P word with no g4 g10 g82 g86 g88 g89"};
  static constexpr DiagnosticRow UnusedQ{"NGC0178", "Q word with no g83"};
  static constexpr DiagnosticRow UnusedR{"NGC0179", "R word with no g code that uses it"};
  static constexpr DiagnosticRow UnusedPolar{"NGC0180",
                                             "Polar coordinates with no motion that uses them"};
  static constexpr DiagnosticRow NegativeD{"NGC0190", "Negative d word tool radius index used"};
  static constexpr DiagnosticRow NegativeF{"NGC0191", "Negative f word used"};
  static constexpr DiagnosticRow NegativeH{"NGC0192",
                                           "Negative h word tool length offset index used"};
  static constexpr DiagnosticRow NegativeL{"NGC0193", "Negative l word used"};
  static constexpr DiagnosticRow NegativeP{"NGC0194", "Negative p word used"};
  static constexpr DiagnosticRow NegativeQ{"NGC0195", "Negative or zero q value used"};
  static constexpr DiagnosticRow NegativeS{"NGC0196", "Negative spindle speed used"};
  static constexpr DiagnosticRow NegativeT{"NGC0197", "Negative tool id used"};
  static constexpr DiagnosticRow ZeroFeedG1{"NGC0200", "Cannot do g1 with zero feed rate"};
  static constexpr DiagnosticRow ZeroFeedArc{"NGC0201", "Cannot make arc with zero feed rate"};
  static constexpr DiagnosticRow ZeroFeedProbe{"NGC0202", "Cannot probe with zero feed rate"};
  static constexpr DiagnosticRow ZeroFeedCycle{"NGC0203", "Cannot feed with zero feed rate"};
  static constexpr DiagnosticRow MissingFG1{"NGC0204", "F word missing with inverse time g1 move"};
  static constexpr DiagnosticRow MissingFArc{"NGC0205",
                                             "F word missing with inverse time arc move"};
  static constexpr DiagnosticRow ArcRadiusTooSmall{"NGC0210",
                                                   "Arc radius too small to reach end point"};
  static constexpr DiagnosticRow ArcSamePoint{"NGC0211", "Current point same as end point of arc"};
  static constexpr DiagnosticRow ArcOffsetPlane{
      "NGC0212", "Offset word given for arc in a plane without that axis"};
  static constexpr DiagnosticRow ArcMixed{"NGC0213", "Mixed radius ijk format for arc"};
  static constexpr DiagnosticRow ArcNone{"NGC0214", "R i j k words all missing for arc"};
  static constexpr DiagnosticRow ArcNoAxis{"NGC0215", "Words missing for arc in its plane"};
  static constexpr DiagnosticRow ArcRadiusDiffers{
      "NGC0216", "Radius to end of arc differs from radius to start"};
  static constexpr DiagnosticRow ArcZero{"NGC0217", "Zero radius arc"};
  static constexpr DiagnosticRow ArcTurns{"NGC0218",
                                          "P word of an arc is not a positive whole number"};
  static constexpr DiagnosticRow ArcTilted{"NGC0219",
                                           "Cannot do an arc in planes g17.1, g18.1 or g19.1"};
  static constexpr DiagnosticRow MissingG4P{"NGC0220", "Dwell time missing with g4"};
  static constexpr DiagnosticRow G10L{"NGC0221", "Line with g10 does not have l2"};
  static constexpr DiagnosticRow G10PInteger{"NGC0222", "P value not an integer with g10 l2"};
  static constexpr DiagnosticRow G10PRange{"NGC0223", "P value out of range with g10 l2"};
  static constexpr DiagnosticRow G53Incremental{"NGC0224", "Cannot use g53 incremental"};
  static constexpr DiagnosticRow G53Motion{"NGC0225", "Must use g0 or g1 with g53"};
  static constexpr DiagnosticRow OffsetIndexMissing{"NGC0226", "Offset index missing"};
  static constexpr DiagnosticRow OffsetIndexRange{"NGC0227", "Tool length offset index too big"};
  static constexpr DiagnosticRow RadiusIndexRange{"NGC0228", "Tool radius index too big"};
  static constexpr DiagnosticRow SlotRange{"NGC0229", "Selected tool slot number too large"};
  static constexpr DiagnosticRow ToolNotFound{"NGC0230",
                                              "Requested tool not found in the tool table"};
  static constexpr DiagnosticRow System5220{"NGC0231",
                                            "Coordinate system index parameter 5220 out of range"};
  static constexpr DiagnosticRow G10Tool{"NGC0232",
                                         "Words missing or out of range with g10 of a tool"};
  static constexpr DiagnosticRow G10Reload{"NGC0233", "G10 l0 not allowed with loaded tool"};
  static constexpr DiagnosticRow ProbeRotary{"NGC0240", "Cannot move rotary axes during probing"};
  static constexpr DiagnosticRow ProbeG93{"NGC0241", "Cannot probe in inverse time feed mode"};
  static constexpr DiagnosticRow ProbeTooClose{"NGC0242", "Start point too close to probe point"};
  static constexpr DiagnosticRow ProbeNoAxis{"NGC0243", "X y and z words all missing with g38 2"};
  static constexpr DiagnosticRow ProbeNotTripped{"NGC0244",
                                                 "Probe move finished without making contact"};
  static constexpr DiagnosticRow ProbeTripped{
      "NGC0245", "Probe is already in the state that the move waits for"};
  static constexpr DiagnosticRow ZeroRepeats{"NGC0250", "Cannot do zero repeats of cycle"};
  static constexpr DiagnosticRow CycleRotary{"NGC0251",
                                             "Cannot put a rotary axis word in canned cycle"};
  static constexpr DiagnosticRow CycleRMissing{"NGC0252", "R clearance plane unspecified in cycle"};
  static constexpr DiagnosticRow CycleDepthMissing{"NGC0253",
                                                   "Bottom value unspecified in canned cycle"};
  static constexpr DiagnosticRow CycleRBelow{"NGC0254", "R less than bottom in cycle"};
  static constexpr DiagnosticRow CycleMissingP{"NGC0255", "Dwell time p word missing with cycle"};
  static constexpr DiagnosticRow CycleMissingQ{"NGC0256", "Q word missing with cycle"};
  static constexpr DiagnosticRow CycleMissingIjk{"NGC0257", "I, j or k word missing with g87"};
  static constexpr DiagnosticRow SpindleG84{"NGC0258", "Spindle not turning clockwise in g84"};
  static constexpr DiagnosticRow SpindleCycle{"NGC0259", "Spindle not turning in cycle"};
  static constexpr DiagnosticRow CycleG93{"NGC0260",
                                          "Cannot use inverse time feed with canned cycles"};
  static constexpr DiagnosticRow CycleComp{"NGC0261",
                                           "Cannot use canned cycles with cutter compensation on"};
  static constexpr DiagnosticRow CyclePlane{"NGC0262", "Cannot use canned cycles in this plane"};
  static constexpr DiagnosticRow CompAxisOffsets{
      "NGC0270", "Cannot change axis offsets with cutter radius comp"};
  static constexpr DiagnosticRow CompUnits{"NGC0271",
                                           "Cannot change units with cutter radius comp"};
  static constexpr DiagnosticRow CompHome{"NGC0272",
                                          "Cannot use g28 or g30 with cutter radius comp"};
  static constexpr DiagnosticRow CompG53{"NGC0273", "Cannot use g53 with cutter radius comp"};
  static constexpr DiagnosticRow CompProbe{"NGC0274", "Cannot probe with cutter radius comp on"};
  static constexpr DiagnosticRow CompPlane{"NGC0275",
                                           "Cannot change plane with cutter radius comp"};
  static constexpr DiagnosticRow CompOnTwice{"NGC0276",
                                             "Cannot turn cutter radius comp on when on"};
  static constexpr DiagnosticRow CompNotXy{"NGC0277",
                                           "Cannot turn cutter radius comp on out of xy plane"};
  static constexpr DiagnosticRow ConcaveCorner{"NGC0278", "Concave corner with cutter radius comp"};
  static constexpr DiagnosticRow Gouging{"NGC0279", "Cutter gouging with cutter radius comp"};
  static constexpr DiagnosticRow CompArcRadius{"NGC0280",
                                               "Tool radius not less than arc radius with comp"};
  static constexpr DiagnosticRow CompEntry{
      "NGC0281", "Length of cutter compensation entry move is not greater than the tool radius"};
  static constexpr DiagnosticRow CompCorner{
      "NGC0282", "Move in concave corner cannot be reached by the tool without gouging"};
  static constexpr DiagnosticRow CompZeroCorner{
      "NGC0283", "Zero degree inside corner is invalid for cutter compensation"};
  static constexpr DiagnosticRow CompExit{
      "NGC0284",
      "The move just after exiting cutter compensation mode must be straight, not an arc"};
  static constexpr DiagnosticRow CompNotAllowed{"NGC0285",
                                                "Not allowed with cutter radius comp on"};
  static constexpr DiagnosticRow CompTooLong{
      "NGC0286", "Too many blocks without motion in the plane while cutter radius comp is on"};
  static constexpr DiagnosticRow CompLathe{
      "NGC0287", "Lathe tool orientation not allowed with cutter radius comp here"};
  static constexpr DiagnosticRow OwordMissing{"NGC0290", "O word: no label"};
  static constexpr DiagnosticRow OwordUnknown{"NGC0291", "O word: unknown keyword"};
  static constexpr DiagnosticRow OwordUndefined{"NGC0292", "Undefined o-word label"};
  static constexpr DiagnosticRow OwordUnmatched{"NGC0293", "O word has no match"};
  static constexpr DiagnosticRow OwordRedefined{"NGC0294", "O word subprogram defined twice"};
  static constexpr DiagnosticRow OwordSubHere{"NGC0295", "O word: subprogram may not begin here"};
  static constexpr DiagnosticRow OwordNesting{"NGC0296", "O words nested too deep"};
  static constexpr DiagnosticRow OwordArguments{"NGC0297", "Too many arguments of a call"};
  static constexpr DiagnosticRow OwordTrailing{"NGC0298", "Unexpected character after O-word"};
  static constexpr DiagnosticRow OwordProfile{"NGC0299", "O words need the profile linuxcnc"};
  static constexpr DiagnosticRow LoopLimit{"NGC0300", "Too many loop passes and calls"};
  static constexpr DiagnosticRow CallNotFound{"NGC0301", "Called program not found"};
  static constexpr DiagnosticRow ReturnOutside{"NGC0302", "Return outside of a subprogram"};
  static constexpr DiagnosticRow OwordExpression{"NGC0303", "O word: condition or count missing"};
  static constexpr DiagnosticRow OwordMixed{
      "NGC0304",
      "Subprogram of o-words and of m98 mixed: sub ends by endsub or return, and is called by "
      "call; a label alone ends by m99, and is called by m98"};
  static constexpr DiagnosticRow Abort{"NGC0310", "Program aborted"};
  static constexpr DiagnosticRow ThreadK{"NGC0320",
                                         "K word missing or not positive with synchronized motion"};
  static constexpr DiagnosticRow ThreadSpindle{"NGC0321",
                                               "Spindle not turning in synchronized motion"};
  static constexpr DiagnosticRow ThreadF{"NGC0322", "F word used with synchronized motion"};
  static constexpr DiagnosticRow ThreadWords{"NGC0323",
                                             "Words missing or out of range with threading cycle"};
  static constexpr DiagnosticRow SplinePlane{"NGC0330", "Splines need the xy plane"};
  static constexpr DiagnosticRow SplineWords{"NGC0331", "Words missing or not allowed with spline"};
  static constexpr DiagnosticRow SplineOpen{"NGC0332", "G5.2 without G5.3, or the reverse"};
  static constexpr DiagnosticRow SpindleMode{"NGC0340",
                                             "S or D word missing or negative with spindle mode"};
  static constexpr DiagnosticRow FeedPerRevolution{"NGC0341",
                                                   "Feed per revolution needs a spindle speed"};
  static constexpr DiagnosticRow IoWords{"NGC0342",
                                         "Words missing or out of range with input or output"};
  static constexpr DiagnosticRow StateStack{"NGC0343", "No saved state to restore"};
  static constexpr DiagnosticRow PolarWords{
      "NGC0344", "Polar coordinates with x or y, at the origin or outside of g17"};
  static constexpr DiagnosticRow OrientWords{"NGC0345", "R word missing or out of range with m19"};
  static constexpr DiagnosticRow ToolNumber{"NGC0346", "Q word missing or negative with m61"};
  static constexpr DiagnosticRow TurningWords{"NGC0353",
                                              "Words missing or out of range with lathe cycle"};
  static constexpr DiagnosticRow TurningContour{"NGC0354",
                                                "Contour of a lathe cycle cannot be cut"};
  static constexpr DiagnosticRow ProbeG95{"NGC0352", "Cannot probe with feed per revolution"};
  static constexpr DiagnosticRow UnusedAxis{"NGC0351", "Nothing on the line takes"};
  static constexpr DiagnosticRow NotSupported{"NGC0350", "Not supported by this interpreter"};
};
// NOLINTEND(readability-identifier-naming)

/// Warnings: words that do not do what they seem to.
inline constexpr std::string_view kCommentLost = "NGC0901";
inline constexpr std::string_view kDeadCode = "NGC0902";
inline constexpr std::string_view kDuplicateSetting = "NGC0903";
inline constexpr std::string_view kFeedBeforeUnits = "NGC0905";
inline constexpr std::string_view kLeadChanges = "NGC0906";
inline constexpr std::string_view kLeadLost = "NGC0907";
inline constexpr std::string_view kContourWords = "NGC0908";

}  // namespace dripline::interpreter::rs274ngc
