#include "protocol/wire/line_settings.hpp"

#include <gmock/gmock.h>
#include <set>

#include "protocol/wire/discipline.hpp"

namespace dripline::wire {
namespace {

using testing::HasSubstr;

TEST(LineSettings, CountsTheBitsOfACharacter) {
  LineSettings settings;
  EXPECT_DOUBLE_EQ(bits_per_character(settings), 10);
  ASSERT_TRUE(apply_short_form("9600e72", settings));
  EXPECT_DOUBLE_EQ(bits_per_character(settings), 11);
  ASSERT_TRUE(apply_short_form("110n81.5", settings));
  EXPECT_DOUBLE_EQ(bits_per_character(settings), 10.5);
}

TEST(LineSettings, KnowsTheLinesOwnRate) {
  LineSettings settings;
  ASSERT_TRUE(apply_short_form("4800e71", settings));
  EXPECT_DOUBLE_EQ(characters_per_second(settings), 480);
  EXPECT_NEAR(static_cast<double>(character_time(settings).count()), 1e9 / 480, 1);
}

TEST(ShortForm, PrintsWhatItReads) {
  for (const std::string_view text : {"9600e72", "57600n81", "110o71.5", "2400m82", "300s71"}) {
    LineSettings settings;
    ASSERT_TRUE(apply_short_form(text, settings)) << text;
    EXPECT_EQ(short_form(settings), text);
  }
}

TEST(ShortForm, RefusesAnythingElseAndChangesNothing) {
  for (const std::string_view text : {"", "e71", "9600", "9600x71", "9600e61", "9600e7", "9600e73",
                                      "9600e711", "9600 e71", "-9600e71", "1e71"}) {
    LineSettings settings;
    const auto applied = apply_short_form(text, settings);
    ASSERT_FALSE(applied) << text;
    EXPECT_THAT(applied.error().what, HasSubstr(text));
    EXPECT_EQ(short_form(settings), "9600n81");
  }
}

TEST(ShortForm, NamesTheLimitOfTheBaudRate) {
  LineSettings settings;
  for (const std::string_view text : {"49n81", "4000001n81", "99999999999999999999n81"}) {
    const auto applied = apply_short_form(text, settings);
    ASSERT_FALSE(applied) << text;
    EXPECT_EQ(applied.error().code, Errc::LimitExceeded);
    EXPECT_THAT(applied.error().what, HasSubstr("50 to 4000000"));
  }
}

TEST(SettingRows, ReadWhatTheyPrint) {
  for (const LineTemplate& row : line_templates()) {
    LineSettings copy;
    for (const SettingRow& setting : setting_rows()) {
      const std::string value = setting.get(row.settings);
      const auto set = setting.set(copy, value);
      ASSERT_TRUE(set) << row.name << ' ' << setting.key << ' ' << value << ": "
                       << set.error().what;
    }
    for (const SettingRow& setting : setting_rows()) {
      EXPECT_EQ(setting.get(copy), setting.get(row.settings)) << row.name << ' ' << setting.key;
    }
  }
}

TEST(SettingRows, HaveOneKeyEach) {
  std::set<std::string_view> keys;
  for (const SettingRow& row : setting_rows()) {
    EXPECT_TRUE(keys.insert(row.key).second) << row.key;
    EXPECT_FALSE(row.text.empty()) << row.key;
    EXPECT_FALSE(row.type.empty()) << row.key;
  }
}

struct BadValue {
  std::string_view name, key, value;
  Errc code;
  std::string_view says;
};

class SettingRowsRefuse : public testing::TestWithParam<BadValue> {};

TEST_P(SettingRowsRefuse, NamingKeyAndValueAndChangeNothing) {
  LineSettings settings;
  const auto set = set_value(settings, GetParam().key, GetParam().value);
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().code, GetParam().code);
  EXPECT_THAT(set.error().what, HasSubstr(std::string(GetParam().key)));
  EXPECT_THAT(set.error().what, HasSubstr(std::string(GetParam().says)));
  const LineSettings untouched;
  for (const SettingRow& row : setting_rows()) EXPECT_EQ(row.get(settings), row.get(untouched));
}

INSTANTIATE_TEST_SUITE_P(
    , SettingRowsRefuse,
    testing::Values(
        BadValue{"unknown_key", "bauds", "9600", Errc::NotFound, "bauds"},
        BadValue{"no_number", "baud", "fast", Errc::Syntax, "'fast'"},
        BadValue{"empty_number", "baud", "", Errc::Syntax, "''"},
        BadValue{"trailing_text", "baud", "9600x", Errc::Syntax, "9600x"},
        BadValue{"too_fast", "baud", "5000000", Errc::LimitExceeded, "50 to 4000000"},
        BadValue{"five_bits", "data_bits", "5", Errc::LimitExceeded, "7 to 8"},
        BadValue{"no_such_parity", "parity", "strange", Errc::Syntax, "none, even, odd"},
        BadValue{"no_such_flow", "flow", "xon", Errc::Syntax, "xonxoff"},
        BadValue{"no_flag", "wait_for_xon", "maybe", Errc::Syntax, "maybe"},
        BadValue{"no_character", "end_char", "ETXX", Errc::Syntax, "ETX"},
        BadValue{"eight_bit_character", "end_char", "0x80", Errc::Syntax, "0x7f"},
        BadValue{"negative_wait", "line_delay_ms", "-1", Errc::Syntax, "-1"},
        BadValue{"endless_wait", "hold_limit_ms", "99999999999", Errc::LimitExceeded, "86400000"},
        BadValue{"rate_is_nan", "reader_cps", "nan", Errc::Syntax, "nan"},
        BadValue{"rate_is_zero", "reader_cps", "0", Errc::LimitExceeded, "1 to"}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(SettingRows, TakeCharactersByNameByCodeAndAsThemselves) {
  LineSettings settings;
  for (const std::string_view value : {"ETX", "0x03", "0x3"}) {
    ASSERT_TRUE(set_value(settings, "end_char", value)) << value;
    EXPECT_EQ(settings.end_character, '\x03');
  }
  ASSERT_TRUE(set_value(settings, "end_char", "%"));
  EXPECT_EQ(settings.end_character, '%');
  ASSERT_TRUE(set_value(settings, "end_char", "3"));
  EXPECT_EQ(settings.end_character, '3');
  ASSERT_TRUE(set_value(settings, "end_char", "none"));
  EXPECT_EQ(settings.end_character, std::nullopt);
}

TEST(SettingRows, TakeNoLimitAsNone) {
  LineSettings settings;
  ASSERT_TRUE(set_value(settings, "answer_limit_ms", "none"));
  EXPECT_EQ(settings.answer_limit, std::nullopt);
  ASSERT_TRUE(set_value(settings, "answer_limit_ms", "250"));
  EXPECT_EQ(settings.answer_limit, std::chrono::milliseconds(250));
}

struct UsualLine {
  std::string_view name, line, flow, control;
};

// Rows: HD-217, HD-218 and HD-232 (a line of the TNC).
TEST(LineTemplates, AreTheControlsUsualLines) {
  for (const UsualLine& usual :
       {UsualLine{"prototrak", "4800e71", "none", "prototrak-plus"},
        UsualLine{"centurion", "9600e72", "xonxoff", "centurion"},
        UsualLine{"tnc155", "2400e71", "heidenhain", "tnc155"},
        UsualLine{"tnc155-rts", "2400e71", "heidenhain", "tnc155"},
        UsualLine{"tnc155-bcc", "2400e71", "heidenhain_bcc", "tnc155"},
        UsualLine{"tektronix1704", "9600n81", "tape_reader", "tektronix-1704"},
        UsualLine{"fanuc", "4800e72", "dc_codes", "fanuc"},
        UsualLine{"plain", "9600n81", "xonxoff", ""}}) {
    const auto found = find_template(usual.name);
    ASSERT_TRUE(found) << usual.name;
    EXPECT_EQ(short_form((*found)->settings), usual.line);
    EXPECT_EQ((*found)->control, usual.control);
    for (const SettingRow& row : setting_rows()) {
      if (row.key == "flow") {
        EXPECT_EQ(row.get((*found)->settings), usual.flow) << usual.name;
      }
    }
  }
}

TEST(LineTemplates, PaceWhatCannotBeHeld) {
  const auto found = find_template("prototrak");
  ASSERT_TRUE(found);
  EXPECT_GT((*found)->settings.line_delay.count(), 0);
}

TEST(LineTemplates, NameTheKnownOnesForAnUnknown) {
  const auto found = find_template("protrak");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Errc::NotFound);
  EXPECT_THAT(found.error().what, HasSubstr("'protrak'"));
  EXPECT_THAT(found.error().what, HasSubstr("prototrak"));
}

TEST(PlainSettings, ThatExcludeEachOtherAreNamed) {
  LineSettings eia;
  eia.code = CharacterCode::Eia;
  const auto made = make_discipline(eia, Role::Host);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, Errc::Unsupported);
  EXPECT_THAT(made.error().what, HasSubstr("rtscts"));
}

}  // namespace
}  // namespace dripline::wire
