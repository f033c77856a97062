#include "clients/tools/lines/centurion_page.hpp"

#include <gtest/gtest.h>

namespace dripline::wire {
namespace {

CenturionPage page_with(const std::vector<std::pair<std::string, std::string>>& entries) {
  CenturionPage page;
  for (const auto& [key, value] : entries) {
    const auto done = set_page_value(page, key, value);
    EXPECT_TRUE(done) << key << ": " << done.error().what;
  }
  return page;
}

TEST(CenturionPage, SetsTheLineOfThePrimaryPort) {  // CEN-197, CEN-198
  const auto page = page_with({{"primary_port", "COM2"},
                               {"com2_baud", "1200"},
                               {"com2_format", "O/8/1"},
                               {"buffer_size", "64"},
                               {"eob_cr_lf", "no"},
                               {"eof_character", "26"}});
  const auto line = line_of_page(page, PagePort::Primary);
  ASSERT_TRUE(line);
  EXPECT_EQ(short_form(*line), "1200o81");
  EXPECT_EQ(line->end_of_block, EndOfBlock::Cr);
  EXPECT_EQ(line->end_character, '\x1A');
  EXPECT_EQ(line->control.buffer_size, 64u);
  EXPECT_EQ(line->control.kind, ControlKind::Centurion);
  EXPECT_EQ(line->flow, Flow::XonXoff);
}

TEST(CenturionPage, MakesTheSecondaryPortTheTapeReaders) {  // CEN-199
  const auto page = page_with({{"secondary_port", "com2"},
                               {"com2_baud", "4800"},
                               {"tape_start", "17"},
                               {"tape_stop", "19"}});
  const auto line = line_of_page(page, PagePort::Secondary);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->baud, 4800u);
  EXPECT_TRUE(line->wait_for_xon);
  EXPECT_EQ(line->control.tape_start, '\x11');
  EXPECT_EQ(line->control.tape_stop, '\x13');
  EXPECT_FALSE(line_of_page(page, PagePort::Primary)->control.tape_start);
}

TEST(CenturionPage, RefusesPortsThatAreNotThere) {  // CEN-197
  EXPECT_EQ(line_of_page(CenturionPage{}, PagePort::Secondary).error().what,
            "secondary_port is none");
  const auto twice = page_with({{"secondary_port", "com1"}});
  EXPECT_EQ(line_of_page(twice, PagePort::Primary).error().what,
            "primary_port and secondary_port are the same connector");
}

TEST(CenturionPage, TakesOnlyWhatThePageHas) {  // CEN-197
  CenturionPage page;
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"com1_baud", "38400"},
                                                        {"com1_baud", "1200x"},
                                                        {"com1_format", "M/7/2"},
                                                        {"com1_format", "E/9/2"},
                                                        {"com1_format", "E/7"},
                                                        {"buffer_size", "257"},
                                                        {"buffer_size", "0"},
                                                        {"eof_character", "128"},
                                                        {"lf_to_cr", "maybe"},
                                                        {"primary_port", "com3"}}) {
    const auto done = set_page_value(page, key, value);
    ASSERT_FALSE(done) << key << " " << value;
    EXPECT_NE(done.error().what.find(key), std::string::npos) << done.error().what;
  }
  EXPECT_EQ(set_page_value(page, "color", "3").error().code, Errc::NotFound);
}

TEST(CenturionPage, ListsTheSettingsOfThePageForALine) {  // CEN-197, CEN-198, CEN-199
  for (const std::string name : {"centurion", "centurion-tape"}) {
    const auto line = (*find_template(name))->settings;
    const auto port = name == "centurion" ? PagePort::Primary : PagePort::Secondary;
    const auto page = page_of_line(line, port);
    ASSERT_TRUE(page) << page.error().what;
    const auto back = line_of_page(*page, port);
    ASSERT_TRUE(back) << back.error().what;
    for (const auto& row : setting_rows()) EXPECT_EQ(row.get(*back), row.get(line)) << row.key;
  }
  LineSettings lf = (*find_template("centurion"))->settings;
  lf.end_of_block = EndOfBlock::Lf;
  EXPECT_TRUE(page_of_line(lf, PagePort::Primary)->lf_becomes_cr);
}

TEST(CenturionPage, NamesWhatTheControlCannotDo) {  // CEN-197
  const auto error = [](const std::string& key, const std::string& value) {
    LineSettings line = (*find_template("centurion"))->settings;
    EXPECT_TRUE(set_value(line, key, value));
    const auto page = page_of_line(line, PagePort::Primary);
    return page ? "" : page.error().what;
  };
  EXPECT_EQ(error("baud", "57600"), "baud 57600: the page has 110, 150, 300, 600 ... 19200");
  EXPECT_EQ(error("parity", "mark"), "line 9600m72: the page has parity N, E and O");
  EXPECT_EQ(error("stop_bits", "1.5"), "stop_bits 1.5: the page has 1 and 2");
  EXPECT_EQ(error("code", "eia"), "code: the control sends and takes ASCII only");
  EXPECT_EQ(error("flow", "xmodem"), "flow: the control does xonxoff and rtscts");
  EXPECT_EQ(error("start_char", "%"), "start_char: the control begins no file with a character");
}

}  // namespace
}  // namespace dripline::wire
