#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <optional>

#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

constexpr std::size_t kLettersOfAFamily = 8;
/// The eight letters of a TNC 155, then those of a TNC 151. R: square wave encoders.
constexpr std::array<std::string_view, 2 * kLettersOfAFamily> kModels{
    "TNC 155 A",  "TNC 155 P",  "TNC 155 AR", "TNC 155 PR", "TNC 155 E",  "TNC 155 V",
    "TNC 155 ER", "TNC 155 VR", "TNC 151 A",  "TNC 151 P",  "TNC 151 AR", "TNC 151 PR",
    "TNC 151 E",  "TNC 151 V",  "TNC 151 ER", "TNC 151 VR"};

bool is_tnc151(std::size_t model) {
  return model >= kLettersOfAFamily;
}
/// E and V, with R or without it.
bool is_limited(std::size_t model) {
  return model % kLettersOfAFamily >= kLettersOfAFamily / 2;
}

/// From which software on a control has a feature.
constexpr int kAlways = 0;
constexpr int kNever = ControlVersion::kHighestSoftware + 1;
struct FeatureRow {
  Feature feature;
  std::string_view name;  ///< after "has no"
  int tnc151_from, tnc155_from;
  bool is_of_all_models;  ///< else E and V have it not
};

constexpr std::array kFeatures{
    FeatureRow{Feature::ThreeAxisLines, "straight lines of three axes at once", kAlways, kAlways,
               false},
    FeatureRow{Feature::Helix, "helices", kAlways, kAlways, false},
    FeatureRow{Feature::BlockwiseTransfer, "transfer blockwise", kAlways, kAlways, false},
    FeatureRow{Feature::Graphics, "graphics", kNever, kAlways, true},
    FeatureRow{Feature::SplitFeed, "feed split between linear and rotary axes", kAlways, 3, true},
    FeatureRow{Feature::ToolStore, "central tool store", 3, 3, true},
    FeatureRow{Feature::NextTool, "search for the next tool", kAlways, 2, true},
    FeatureRow{Feature::Hardcopy, "hardcopy of its graphics", kNever, 3, true},
    FeatureRow{Feature::HardcopyIn8Bits, "hardcopy with 8 data bits by itself", kNever, 8, true},
    FeatureRow{Feature::PrinterParameters, "machine parameters 225 to 234", kAlways, 3, true},
    FeatureRow{Feature::LaterParameters, "machine parameters 235 and 236", kAlways, 6, true},
    FeatureRow{Feature::FastSpindle, "speeds above 9000", kAlways, 6, true},
    FeatureRow{Feature::TouchProbe, "touch probe functions", kAlways, 6, true},
    FeatureRow{Feature::SectionProjections, "US projection of three planes", kNever, 6, true},
    FeatureRow{Feature::StopBlock, "G38", 8, 8, true},
};

constexpr bool are_features_in_order() {
  for (std::size_t i = 0; i < kFeatures.size(); ++i) {
    if (static_cast<std::size_t>(kFeatures[i].feature) != i) return false;
  }
  return kFeatures.size() == static_cast<std::size_t>(Feature::Count);
}
static_assert(are_features_in_order());

constexpr std::uint32_t bit(Feature feature) {
  return 1u << static_cast<unsigned>(feature);
}
constexpr std::uint32_t kOfBlocks = bit(Feature::ThreeAxisLines) | bit(Feature::Helix) |
                                    bit(Feature::NextTool) | bit(Feature::FastSpindle) |
                                    bit(Feature::TouchProbe) | bit(Feature::StopBlock);

int first_software(const FeatureRow& row, std::size_t model) {
  if (!row.is_of_all_models && is_limited(model)) return kNever;
  return is_tnc151(model) ? row.tnc151_from : row.tnc155_from;
}

}  // namespace

ControlVersion::ControlVersion(std::size_t model, int software)
    : model_(static_cast<std::uint8_t>(model)), software_(static_cast<std::uint8_t>(software)) {
  invariant(model < kModels.size(), "a model has a name");
  for (const FeatureRow& row : kFeatures) {
    if (first_software(row, model) > software) missing_ |= bit(row.feature);
  }
  takes_all_blocks_ = (missing_ & kOfBlocks) == 0;
}

std::string ControlVersion::lacks(Feature feature) const {
  const FeatureRow& row = kFeatures[static_cast<std::size_t>(feature)];
  const int from = first_software(row, model_);
  if (from == kNever) return fmt::format("a {} has no {}", model(), row.name);
  return fmt::format("a {} with software {:02} has no {} (from software {:02})", model(), software_,
                     row.name, from);
}

std::string_view ControlVersion::model() const {
  return kModels[model_];
}

std::span<const std::size_t> ControlVersion::memories() const {
  static constexpr std::array<std::size_t, 2> kMemories{3'100, 1'200};
  return std::span(kMemories).first(is_tnc151(model_) ? 2 : 1);
}

namespace {

/// The last two digits of `nc_software`, where that is given.
Result<std::optional<int>> software_of_number(const Options& options) {
  const auto number = options.text("nc_software", "");
  if (!number) return fail(number.error());
  std::string digits;
  for (const char c : *number) {
    if (c >= '0' && c <= '9') digits += c;
  }
  if (digits.size() < 2) return std::optional<int>();
  return std::optional(10 * (digits.end()[-2] - '0') + (digits.end()[-1] - '0'));
}

}  // namespace

std::span<const std::string_view> model_names() {
  return kModels;
}

Result<ControlVersion> version_of(const Options& options) {
  const auto model = options.text("model", kModels.front());
  if (!model) return fail(model.error());
  const auto found = std::ranges::find(kModels, *model);
  if (found == kModels.end()) {
    return fail(Errc::Syntax, "option model: \"{}\" is not one of {}", *model,
                fmt::join(kModels, ", "));
  }
  const auto stated = software_of_number(options);
  if (!stated) return fail(stated.error());
  const auto software =
      options.integer("software", stated->value_or(ControlVersion::kNewestSoftware));
  if (!software) return fail(software.error());
  if (*stated && **stated != *software) {
    return fail(Errc::Syntax, "option software: {}, and nc_software ends in {:02}", *software,
                **stated);
  }
  const bool is_from_number = stated->has_value() && options.find("software") == nullptr;
  if (is_from_number && *software < 1) {
    return fail(Errc::Syntax, "option nc_software: it ends in 00, and software begins with 01");
  }
  if (*software < 1 || *software > ControlVersion::kHighestSoftware) {
    return fail(Errc::Syntax, "option software: {} is not a number from 1 to {}", *software,
                ControlVersion::kHighestSoftware);
  }
  return ControlVersion(static_cast<std::size_t>(found - kModels.begin()),
                        static_cast<int>(*software));
}

}  // namespace dripline::interpreter::tnc155
