#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "gateway/interpreter/core/option.hpp"

namespace dripline::interpreter::tnc155 {

/// Features that not every TNC 151/155 has: they depend on the model or on its software.
enum class Feature : std::uint8_t {
  ThreeAxisLines,      ///< a straight line of three axes at once
  Helix,               ///< a circle and the third axis
  BlockwiseTransfer,   ///< a program runs while it is transferred
  Graphics,            ///< the blank is cut on the screen
  SplitFeed,           ///< F applies to the path of linear and rotary axes together
  ToolStore,           ///< program 0
  NextTool,            ///< G51, TOOL DEF without L and R
  Hardcopy,            ///< of the graphics, to a printer
  HardcopyIn8Bits,     ///< without MP222 = 169
  PrinterParameters,   ///< MP225 to MP234
  LaterParameters,     ///< MP235, MP236
  FastSpindle,         ///< S above 9000
  TouchProbe,          ///< functions by hand, TCH PROBE, G55
  SectionProjections,  ///< three planes as in the US besides DIN
  StopBlock,           ///< G38
  Count,
};

/// Which control it is: its model and the number of its software. Value type; any thread.
/// Source: the manual, versions, and the features named there with a software number.
class ControlVersion {
 public:
  static constexpr int kNewestSoftware = 8;
  static constexpr int kHighestSoftware = 99;  ///< two digits; has what the newest known one has

  /// A TNC 155 A with the newest software, which has every feature.
  ControlVersion() = default;
  /// `model`: its place in `model_names`.
  ControlVersion(std::size_t model, int software);

  bool has(Feature feature) const { return (missing_ >> static_cast<unsigned>(feature) & 1u) == 0; }
  /// Nothing is missing that a block of a program can ask for.
  bool takes_all_blocks() const { return takes_all_blocks_; }
  /// Why `has` is false: "a TNC 155 A with software 05 has no touch probe functions (from software
  /// 06)".
  std::string lacks(Feature feature) const;
  std::string_view model() const;
  /// Blocks that its program memory may hold.
  std::span<const std::size_t> memories() const;

 private:
  std::uint8_t model_ = 0;
  std::uint8_t software_ = kNewestSoftware;
  bool takes_all_blocks_ = true;
  std::uint32_t missing_ = 0;
};

/// As the option `model` spells them: "TNC 155 A" ...
std::span<const std::string_view> model_names();

/// The options `model` and `software` alone, of options that may be another control's besides. A
/// control that says neither is the newest and has everything. Errors: Syntax, naming the option.
Result<ControlVersion> version_of(const Options& options);

}  // namespace dripline::interpreter::tnc155
