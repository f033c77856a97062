#include "server/folders/name_rules.hpp"

#include <gtest/gtest.h>

namespace dripline::folders {
namespace {

FolderSettings read_one(const std::string& toml) {
  const auto folders = read_folders(toml);
  EXPECT_TRUE(folders) << folders.error().what;
  return folders && folders->size() == 1 ? folders->front() : FolderSettings{};
}

constexpr const char* kFolder = "[[folder]]\nname = \"cam\"\npath = \"/srv/cam\"\n";

TEST(FolderSettings, HaveDefaultsAndEveryKey) {
  const auto plain = read_one(kFolder);
  EXPECT_EQ(plain.unchanged_time, std::chrono::seconds(2));
  EXPECT_TRUE(plain.is_checked);
  EXPECT_EQ(plain.done, "done");
  const auto full = read_one(std::string(kFolder) +
                             "machine = \"mill-3\"\nauthor = \"{owner}\"\ncomment = \"by CAM\"\n"
                             "check = false\nunchanged_seconds = 0\npoll_seconds = 30\nmax_mb = 8\n"
                             "done = \"ok\"\nfailed = \"bad\"\n"
                             "[[folder.rule]]\nmatches = '.*\\.bak'\nignore = true\n");
  EXPECT_EQ(full.machine, "mill-3");
  EXPECT_FALSE(full.is_checked);
  EXPECT_EQ(full.unchanged_time.count(), 0);
  EXPECT_EQ(full.poll, std::chrono::seconds(30));
  EXPECT_EQ(full.max_bytes, 8u << 20);
  EXPECT_EQ(full.failed, "bad");
  ASSERT_EQ(full.rules.size(), 1u);
  EXPECT_TRUE(full.rules[0].is_ignored);
}

struct BadFolder {
  const char* name;
  const char* toml;
  const char* words;  ///< in the error
};
class FolderErrors : public testing::TestWithParam<BadFolder> {};

TEST_P(FolderErrors, NameLineAndKey) {
  const auto read = read_folders(std::string(kFolder) + GetParam().toml);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().what.find(GetParam().words), std::string::npos) << read.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , FolderErrors,
    testing::Values(BadFolder{"no_toml", "x", "line 4"},
                    BadFolder{"unknown_key", "paht = 1", "line 4: key 'paht'"},
                    BadFolder{"relative_path", "[[folder]]\nname=\"b\"\npath = \"cam\"",
                              "must be absolute"},
                    BadFolder{"no_path", "[[folder]]\nname=\"b\"", "has no path"},
                    BadFolder{"bad_name", "[[folder]]\nname=\"B b\"\npath = \"/b\"", "folder:"},
                    BadFolder{"twice", "[[folder]]\nname=\"cam\"\npath = \"/b\"", "is there twice"},
                    BadFolder{"same_path", "[[folder]]\nname=\"b\"\npath = \"/x/../srv/cam\"",
                              "is there twice"},
                    BadFolder{"outside", "done = \"../x\"", "below this one"},
                    BadFolder{"one_for_both", "done = \"x\"\nfailed = \"x\"", "are both 'x'"},
                    BadFolder{"too_big", "max_mb = 100000", "max_mb is 100000: 1 to 1024"},
                    BadFolder{"wrong_type", "check = 1", "check must be true or false"},
                    BadFolder{"rule_without_pattern", "[[folder.rule]]\nprogram = \"x\"",
                              "needs the key matches"},
                    BadFolder{"bad_pattern", "[[folder.rule]]\nmatches = \"(\"", "matches '('"},
                    BadFolder{"no_array", "rule = 1", "write [[folder.rule]]"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(NameRules, WithoutRulesTheStemIsTheProgram) {
  const auto named = name_program(read_one(kFolder), "O0200.nc", "anna");
  ASSERT_TRUE(named) << named.error().what;
  EXPECT_EQ(named->program, "O0200");
  EXPECT_EQ(named->author, "folder cam");
  EXPECT_EQ(named->comment, "O0200.nc");
}

TEST(NameRules, FillInWhatThePatternFindsInItsOrder) {
  auto folder = read_one(std::string(kFolder) + R"(author = "{owner}"
comment = "{name} of {part}"
[[folder.rule]]
matches = '(?P<machine>mill-\d+)_(?P<part>\w+)_op(?P<op>\d+)\.(nc|h)'
program = "{part}-{op}.{extension}"
machine = "{machine}"
[[folder.rule]]
matches = '.*\.txt'
ignore = true
)");
  const auto named = name_program(folder, "mill-3_P77_op10.nc", "anna");
  ASSERT_TRUE(named) << named.error().what;
  EXPECT_EQ(named->program, "P77-10.nc");
  EXPECT_EQ(named->machine, "mill-3");
  EXPECT_EQ(named->author, "anna");
  EXPECT_EQ(named->comment, "mill-3_P77_op10.nc of P77");
  EXPECT_TRUE(name_program(folder, "notes.txt", "")->is_ignored);
  const auto none = name_program(folder, "xmill-3_P77_op10.nc", "anna");
  ASSERT_FALSE(none) << "the whole name has to fit";
  EXPECT_EQ(none.error().code, Errc::NotFound);
}

TEST(NameRules, WhatComesOutIsAName) {
  auto folder =
      read_one(std::string(kFolder) +
               "[[folder.rule]]\nmatches = '(?P<all>.*)'\nprogram = \"{all}{nothing}\"\n");
  const auto unknown = name_program(folder, "a.nc", "");
  ASSERT_FALSE(unknown) << "an unknown {word} is a mistake that is seen";
  EXPECT_NE(unknown.error().what.find("a.nc"), std::string::npos);
}

TEST(FileNames, AreTemporaryOrPrintable) {
  for (const char* name : {".a", "a.tmp", "a.nc~", "a.nc.part", "Thumbs.db"})
    EXPECT_TRUE(is_temporary_name(name)) << name;
  EXPECT_FALSE(is_temporary_name("a.nc"));
  EXPECT_EQ(printable_name("a\nb%/\x7f"), "a%0Ab%25%2F%7F");
  EXPECT_EQ(printable_name("Gehäuse.nc"), "Gehäuse.nc");
  EXPECT_EQ(printable_name("\xc2\x9b.nc"), "%C2%9B.nc") << "a control character of two bytes";
  EXPECT_EQ(printable_name("\xff"), "%FF");
  EXPECT_LE(printable_name(std::string(250, '\n')).size(), 200u);
  EXPECT_TRUE(is_printable_name("O1 a.nc"));
  EXPECT_FALSE(is_printable_name("50%.nc"));
}

}  // namespace
}  // namespace dripline::folders
