#include <gtest/gtest.h>
#include <fstream>
#include <sstream>

#include "gateway/app/options.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/registry.hpp"
#include "protocol/wire/line_settings.hpp"

namespace dripline::gateway {
namespace {

GatewayOptions base() {
  GatewayOptions options;
  options.machine = "lathe-1";
  options.control = "centurion";
  options.state = "/tmp/state";
  return options;
}

/// A port's machine speaks what its template names: a program for that control must be taken.
TEST(LineTemplates, NameControlsByTheNamesTheyAreRegisteredUnder) {
  for (const wire::LineTemplate& usual : wire::line_templates()) {
    const bool is_known = interpreter::find_dialect(usual.control).has_value();
    const bool is_to_come = usual.control == "tnc155";
    EXPECT_TRUE(usual.control.empty() || is_known || is_to_come) << usual.name;
  }
}

TEST(LineOptions, TakeTheControlsOwnTemplateAndChangeIt) {
  GatewayOptions options = base();
  ASSERT_TRUE(
      apply_config("line = '/dev/ttyS3'\n"
                   "line-setting = ['baud=4800', 'end_char=%']\n"
                   "line-buffer = 4096\n",
                   options));
  ASSERT_TRUE(complete(options));
  EXPECT_EQ(options.line->template_name, "centurion");
  EXPECT_EQ(options.line->settings.baud, 4800U);
  EXPECT_EQ(options.line->settings.data_bits, 7U) << "the template's";
  EXPECT_EQ(options.line->settings.end_character, '%');
  EXPECT_EQ(options.line->buffer_bytes, 4096U);
}

TEST(LineOptions, ASettingOfTheCommandLineMayBeGivenMoreThanOnce) {
  GatewayOptions options = base();
  for (const OptionRow& row : option_rows()) {
    if (row.key == "line") {
      ASSERT_TRUE(row.value.set(options, "tcp://moxa:4001"));
    }
    if (row.key != "line-setting") continue;
    EXPECT_EQ(row.value.written, process::Written::List);
    ASSERT_TRUE(row.value.set(options, "flow=rtscts\nbaud=19200"));
  }
  ASSERT_TRUE(complete(options));
  EXPECT_EQ(options.line->settings.flow, wire::Flow::RtsCts);
  EXPECT_EQ(options.line->settings.baud, 19200U);
}

TEST(LineOptions, ATncAlwaysAsks) {
  GatewayOptions options = base();
  ASSERT_TRUE(apply_config("line = '/dev/ttyS3'\nline-template = 'tnc155-bcc'\n", options));
  ASSERT_TRUE(complete(options));
  EXPECT_EQ(options.line->request, "next");
}

// HD-235: the control that the gateway is in the place of has no transfer blockwise.
TEST(LineOptions, SpeakNothingBlockwiseForATncWithoutIt) {
  const auto refusal = [](const std::string& line_template, const std::string& model) {
    GatewayOptions options = base();
    options.control = "tnc155";
    EXPECT_TRUE(
        apply_config("line = '/dev/ttyS3'\nline-template = '" + line_template + "'\n", options));
    EXPECT_TRUE(complete(options));
    const auto setup = interpreter::parse_setup("[control]\nmodel = \"" + model + "\"\n");
    const auto fits = check_line(options, *setup);
    return fits ? "" : fits.error().what;
  };
  EXPECT_EQ(refusal("tnc155-bcc", "TNC 155 P"), "");
  EXPECT_EQ(refusal("tnc155", "TNC 155 V"), "");
  EXPECT_EQ(refusal("tnc155-bcc", "TNC 155 V"),
            "--line /dev/ttyS3 speaks heidenhain_bcc: a TNC 155 V has no transfer blockwise; flow "
            "heidenhain (template tnc155) is its interface");
}

/// The letter in the headings that a TNC of ours sends: the line's own setting, else the setup's.
TEST(LineOptions, TakeTheLetterOfHeadingsFromTheSetup) {  // HD-222
  const auto heading = [](const char* line, const char* setup) {
    GatewayOptions options = base();
    EXPECT_TRUE(apply_config(std::string("line = '/dev/ttyS3'\n") + line, options));
    EXPECT_TRUE(complete(options));
    const auto read = interpreter::parse_setup(setup);
    EXPECT_TRUE(read) << read.error().what;
    const auto settings = line_settings_of(*options.line, read->control);
    EXPECT_TRUE(settings) << settings.error().what;
    return settings->heidenhain.heading;
  };
  constexpr const char* kBlockwise = "line-template = 'tnc155-bcc'\n";
  constexpr const char* kOwn = "line-template = 'tnc155-bcc'\nline-setting = ['tnc_heading=D']\n";
  EXPECT_EQ(heading(kBlockwise, ""), '%');
  EXPECT_EQ(heading(kBlockwise, "[control]\nheading_letter = \"H\"\n"), 'H');
  EXPECT_EQ(heading(kOwn, "[control]\nheading_letter = \"H\"\n"), 'D');
  EXPECT_EQ(heading("line-template = 'centurion'\n", "[control]\nheading_letter = 3\n"), '%');
  GatewayOptions options = base();
  ASSERT_TRUE(apply_config(std::string("line = '/dev/ttyS3'\n") + kBlockwise, options));
  ASSERT_TRUE(complete(options));
  const auto bad = interpreter::parse_setup("[control]\nheading_letter = \"D\"\n");
  EXPECT_FALSE(line_settings_of(*options.line, bad->control));
}

struct Refused {
  const char* name;
  const char* toml;
  const char* named;
};
class LineOptionsRefuse : public testing::TestWithParam<Refused> {};

TEST_P(LineOptionsRefuse, AndNameWhatIsWrong) {
  GatewayOptions options = base();
  auto done = apply_config(GetParam().toml, options);
  if (done) done = complete(options);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().what.find(GetParam().named), std::string::npos) << done.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , LineOptionsRefuse,
    testing::Values(
        Refused{"no_address", "line-template = 'centurion'\n", "--line ADDRESS"},
        Refused{"unknown_template", "line = '/dev/ttyS3'\nline-template = 'heidi'\n", "heidi"},
        Refused{"unknown_setting", "line = '/dev/ttyS3'\nline-setting = ['bauds=3']\n", "bauds"},
        Refused{"bad_value", "line = '/dev/ttyS3'\nline-setting = ['parity=some']\n", "some"},
        Refused{"baud_of_no_tnc",
                "line = '/dev/ttyS3'\nline-template = 'tnc155'\nline-setting = ['baud=19200']\n",
                "baud 19200: a TNC 151/155 has 110"},
        Refused{"no_value", "line = '/dev/ttyS3'\nline-setting = 'baud'\n", "key=value"},
        Refused{"small_buffer", "line = '/dev/ttyS3'\nline-buffer = 10\n", "256"},
        Refused{"list_where_none_is", "line = ['/dev/ttyS3']\n", "not a list"},
        Refused{"neither_server_nor_line", "server = 'none'\n", "--server none"}),
    [](const auto& i) { return std::string(i.param.name); });

GatewayOptions beside_a_control(const std::string& more) {
  GatewayOptions options = base();
  EXPECT_TRUE(apply_config("motion = 'line:/dev/ttyUSB0'\n" + more, options));
  return options;
}

TEST(BesideAControl, TheLineIsTheMotions) {
  GatewayOptions options =
      beside_a_control("line-setting = ['4800e71', 'end_char=%']\nline-ahead-s = 60\n");
  ASSERT_TRUE(complete(options));
  EXPECT_TRUE(options.drives_control());
  EXPECT_EQ(options.line->address, "/dev/ttyUSB0");
  EXPECT_EQ(options.line->template_name, "centurion");
  EXPECT_EQ(wire::short_form(options.line->settings), "4800e71");
  EXPECT_EQ(options.line->settings.end_character, '%');
  EXPECT_EQ(options.line->ahead, std::chrono::seconds(60));
  EXPECT_FALSE(options.is_unattended) << "people are at a real machine";
}

TEST(BesideAControl, RefusesWhatOnlyTheOtherEndHas) {
  for (const char* more : {"line = '/dev/ttyS3'\n", "server = 'none'\n"}) {
    GatewayOptions options = beside_a_control(more);
    EXPECT_FALSE(complete(options)) << more;
  }
  GatewayOptions options = base();
  EXPECT_FALSE(apply_config("motion = 'line:'\n", options) && complete(options));
}

TEST(BesideAControl, ATncIsNotAskedByItself) {
  GatewayOptions options = beside_a_control("line-template = 'tnc155-bcc'\n");
  ASSERT_TRUE(complete(options));
  EXPECT_EQ(options.line->request, "");
}

TEST(BesideAControl, TheExampleIsRead) {
  std::ifstream file("deploy/examples/box/mill.toml");
  std::ostringstream text;
  text << file.rdbuf();
  GatewayOptions options;
  options.state = "/tmp/state";
  const auto applied = apply_config(text.str(), options);
  ASSERT_TRUE(applied) << applied.error().what;
  const auto done = complete(options);
  ASSERT_TRUE(done) << done.error().what;
  EXPECT_TRUE(options.drives_control());
  EXPECT_EQ(options.line->ahead, std::chrono::minutes(10));
}

}  // namespace
}  // namespace dripline::gateway
