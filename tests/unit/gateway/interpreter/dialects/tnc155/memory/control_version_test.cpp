#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"

#include <gtest/gtest.h>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

Setup setup_of(const std::string& options) {
  auto setup = parse_setup("[control]\n" + options);
  EXPECT_TRUE(setup) << setup.error().what;
  return setup ? *std::move(setup) : Setup{};
}

ControlVersion version(const std::string& model, int software) {
  const auto read = version_of(
      setup_of("model = \"" + model + "\"\nsoftware = " + std::to_string(software)).control);
  EXPECT_TRUE(read) << read.error().what;
  return read ? *read : ControlVersion{};
}

std::string error(const std::string& options) {
  const auto read = read_options(setup_of(options));
  return read ? "" : read.error().what;
}

constexpr int kNever = 0;
struct Gate {
  std::string_view name;
  Feature feature;
  int tnc155, tnc151;  ///< the first software that has it; 1: all
};

// HD-238: each feature of the manual's list, the software before it and the one it came with.
class SoftwareGate : public testing::TestWithParam<Gate> {};

TEST_P(SoftwareGate, OpensWithItsSoftware) {
  const Gate& gate = GetParam();
  for (const auto& [model, first] :
       {std::pair{"TNC 155 A", gate.tnc155}, std::pair{"TNC 151 PR", gate.tnc151}}) {
    for (int software = 1; software <= 9; ++software) {
      EXPECT_EQ(version(model, software).has(gate.feature), first != kNever && software >= first)
          << model << " with software " << software;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , SoftwareGate,
    testing::Values(Gate{"graphics", Feature::Graphics, 1, kNever},
                    Gate{"split_feed", Feature::SplitFeed, 3, 1},
                    Gate{"tool_store", Feature::ToolStore, 3, 3},
                    Gate{"next_tool", Feature::NextTool, 2, 1},
                    Gate{"hardcopy", Feature::Hardcopy, 3, kNever},
                    Gate{"hardcopy_in_8_bits", Feature::HardcopyIn8Bits, 8, kNever},
                    Gate{"printer_parameters", Feature::PrinterParameters, 3, 1},
                    Gate{"later_parameters", Feature::LaterParameters, 6, 1},
                    Gate{"fast_spindle", Feature::FastSpindle, 6, 1},
                    Gate{"touch_probe", Feature::TouchProbe, 6, 1},
                    Gate{"section_projections", Feature::SectionProjections, 6, kNever},
                    Gate{"stop_block", Feature::StopBlock, 8, 8}),
    [](const auto& tested) { return std::string(tested.param.name); });

constexpr Feature kOfSimultaneousAxes[] = {Feature::ThreeAxisLines, Feature::Helix,
                                           Feature::BlockwiseTransfer};

// HD-239, HD-235
TEST(ControlVersion, LeavesThreeAxesHelicesAndBlockwiseTransferOutOfEAndV) {
  for (const std::string_view model : model_names()) {
    const bool is_limited = model.find_first_of("EV") != model.npos;
    for (const Feature feature : kOfSimultaneousAxes) {
      EXPECT_EQ(version(std::string(model), 8).has(feature), !is_limited) << model;
    }
  }
}

TEST(ControlVersion, HasEverythingWhereNothingIsSaid) {
  const auto none = version_of(Options{});
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->takes_all_blocks());
  EXPECT_EQ(none->model(), "TNC 155 A");
  for (std::size_t i = 0; i < static_cast<std::size_t>(Feature::Count); ++i) {
    EXPECT_TRUE(none->has(static_cast<Feature>(i))) << i;
    EXPECT_TRUE(version("TNC 155 A", 8).has(static_cast<Feature>(i))) << i;
  }
}

TEST(ControlVersion, SaysWhatIsMissingAndSinceWhenItIsThere) {
  EXPECT_EQ(version("TNC 155 P", 5).lacks(Feature::TouchProbe),
            "a TNC 155 P with software 05 has no touch probe functions (from software 06)");
  EXPECT_EQ(version("TNC 155 VR", 8).lacks(Feature::Helix), "a TNC 155 VR has no helices");
  EXPECT_EQ(version("TNC 151 A", 8).lacks(Feature::Graphics), "a TNC 151 A has no graphics");
}

TEST(ControlVersion, NamesTheModelsAndTheSoftwareThereAre) {
  const std::string model = error("model = \"TNC 355\"");
  EXPECT_TRUE(model.starts_with("option model: \"TNC 355\" is not one of TNC 155 A, ")) << model;
  EXPECT_EQ(error("software = 0"), "option software: 0 is not a number from 1 to 99");
  EXPECT_EQ(error("software = 100"), "option software: 100 is not a number from 1 to 99");
  EXPECT_NE(error("software = \"08\""), "");
}

// HD-238: options of the setup that the software has not.
TEST(ControlVersion, RefusesOptionsThatTheControlHasNot) {
  EXPECT_EQ(error("central_tool_file = true\nsoftware = 2"),
            "option central_tool_file: a TNC 155 A with software 02 has no central tool store "
            "(from software 03)");
  EXPECT_EQ(error("central_tool_file = true\nsoftware = 3"), "");
  EXPECT_EQ(error("rotary_feed = \"contour\"\nsoftware = 2"),
            "option rotary_feed: a TNC 155 A with software 02 has no feed split between linear and "
            "rotary axes (from software 03)");
  EXPECT_EQ(error("rotary_feed = \"rotary\"\nsoftware = 2"), "");
  EXPECT_EQ(error("rotary_feed = \"contour\"\nsoftware = 2\nmodel = \"TNC 151 A\""), "");
  EXPECT_EQ(error("blockwise_restrictions = true\nmodel = \"TNC 151 E\""),
            "option blockwise_restrictions: a TNC 151 E has no transfer blockwise");
  EXPECT_EQ(error("blockwise_restrictions = true\nmodel = \"TNC 151 A\""), "");
}

// HD-087, HD-238: the NC software's number says it too.
TEST(ControlVersion, SoftwareIsTheEndOfItsNumber) {
  EXPECT_EQ(error("nc_software = \"227 020 02\"\ncentral_tool_file = true"),
            "option central_tool_file: a TNC 155 A with software 02 has no central tool store "
            "(from software 03)");
  EXPECT_EQ(error("nc_software = \"227 020 03\"\ncentral_tool_file = true"), "");
  EXPECT_EQ(error("nc_software = \"227 020 03\"\nsoftware = 3"), "");
  EXPECT_EQ(error("nc_software = \"227 020 03\"\nsoftware = 8"),
            "option software: 8, and nc_software ends in 03");
  EXPECT_EQ(error("nc_software = \"227 020 00\""),
            "option nc_software: it ends in 00, and software begins with 01");
}

// HD-239: 3100 blocks, of a TNC 151 they may be 1200.
TEST(ControlVersion, HasTheMemoryOfItsModel) {
  EXPECT_EQ(error("memory_blocks = 1200\nmodel = \"TNC 151 A\""), "");
  EXPECT_EQ(error("memory_blocks = 3100\nmodel = \"TNC 151 A\""), "");
  EXPECT_EQ(error("memory_blocks = 1201\nmodel = \"TNC 151 A\""),
            "option memory_blocks: 1201: a TNC 151 A has 3100 or 1200");
  EXPECT_EQ(error("memory_blocks = 1200\nmodel = \"TNC 155 A\""),
            "option memory_blocks: 1200: a TNC 155 A has 3100");
  EXPECT_EQ(error("memory_blocks = 1200"), "") << "no model is named";
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
