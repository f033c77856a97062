// What programs are for, and listings that choose by it.
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class FieldsTest : public ContractTest {
 protected:
  Result<void> describe(const std::string& program, const FieldChange& change,
                        std::optional<std::uint64_t> revision = {}) {
    return store_->programs.describe(
        {.program = program, .revision = revision, .change = change, .who = {"anna", "t", ""}});
  }
  std::string listed(const ProgramFilter& filter, Page page = {}) {
    std::string names;
    const auto programs = store_->programs.list(filter, page);
    EXPECT_TRUE(programs) << programs.error().what;
    for (const auto& program : programs.value()) names += program.latest.program + " ";
    return names;
  }
};

TEST_P(FieldsTest, BelongToTheProgramAndTheCamFileToTheRevision) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  ASSERT_TRUE(push("p.nc", "M31\n"));
  ASSERT_TRUE(describe("p.nc", {.part = "4711", .material = "1.4301", .cam_file = "p.f3d"}));
  EXPECT_EQ(store_->programs.fields("p.nc"), (ProgramFields{"4711", "", "1.4301", ""}));
  EXPECT_EQ(store_->programs.revision("p.nc", 2)->cam_file, "p.f3d");
  EXPECT_EQ(store_->programs.revision("p.nc", 1)->cam_file, "");
  ASSERT_TRUE(describe("p.nc", {.part = "", .cam_file = "old.f3d"}, 1));
  EXPECT_EQ(store_->programs.fields("p.nc")->part, "");
  EXPECT_EQ(store_->programs.revision("p.nc", 1)->cam_file, "old.f3d");
  const auto entry = store_->audit.list({.limit = 1, .offset = 0}).value().front();
  EXPECT_EQ(entry.action, "program.describe");
  EXPECT_EQ(entry.who.name, "anna");
  EXPECT_EQ(entry.detail, "part '4711' to '', CAM file of revision 1 '' to 'old.f3d'");
  ASSERT_TRUE(describe("p.nc", {.part = ""}));
  EXPECT_EQ(store_->audit.list({.limit = 1, .offset = 0})->front().detail, entry.detail)
      << "no change, no entry";
}

TEST_P(FieldsTest, AreRefusedForWhatIsNotThere) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  EXPECT_EQ(describe("q.nc", {.part = "1"}).error().code, Errc::NotFound);
  EXPECT_EQ(describe("p.nc", {.cam_file = "1"}, 2).error().code, Errc::NotFound);
  EXPECT_EQ(describe("p.nc", {.machine_group = "mills"}).error().what,
            "there is no machine group 'mills'");
  EXPECT_TRUE(describe("p.nc", {.machine_group = kAllMachines}));
}

TEST_P(FieldsTest, ComeWithAnUploadAlsoWhenTheTextIsTheSame) {
  const auto push_with = [&](const std::string& text, const FieldChange& change) {
    Upload upload;
    upload.program = "p.nc";
    upload.author = "anna";
    upload.change = change;
    const auto id = store_->uploads.begin(upload)->id;
    EXPECT_TRUE(store_->uploads.append(id, 0, bytes_of(text)));
    return store_->uploads.commit(id, {}).value();
  };
  EXPECT_EQ(push_with("M30\n", {.part = "4711", .cam_file = "a.f3d"}).cam_file, "a.f3d");
  EXPECT_EQ(push_with("M31\n", {}).cam_file, "") << "of these bytes nothing was stated";
  EXPECT_EQ(store_->programs.fields("p.nc")->part, "4711");
  const auto same = push_with("M31\n", {.operation = "20", .cam_file = "b.f3d"});
  EXPECT_EQ(same.number, 2u);
  EXPECT_EQ(same.cam_file, "b.f3d");
  EXPECT_EQ(store_->programs.fields("p.nc"), (ProgramFields{"4711", "20", "", ""}));
  Upload upload;
  upload.program = "p.nc";
  upload.change.machine_group = "mills";
  EXPECT_EQ(store_->uploads.begin(upload).error().code, Errc::Conflict);
}

TEST_P(FieldsTest, GoWithACopyAndEndWithARemoval) {
  ASSERT_TRUE(push("p.nc", "M30\n"));
  ASSERT_TRUE(describe("p.nc", {.part = "4711", .cam_file = "p.f3d"}));
  ASSERT_TRUE(store_->programs.copy({.from = "p.nc", .to = "q.nc", .who = {}}, {}));
  EXPECT_EQ(store_->programs.fields("q.nc")->part, "4711");
  EXPECT_EQ(store_->programs.revision("q.nc", {})->cam_file, "p.f3d");
  ASSERT_TRUE(store_->programs.remove("p.nc"));
  EXPECT_EQ(store_->programs.fields("p.nc").error().code, Errc::NotFound);
  ASSERT_TRUE(push("p.nc", "M99\n"));
  EXPECT_EQ(store_->programs.fields("p.nc")->part, "") << "another program";
}

TEST_P(FieldsTest, ListingsChooseByThemAndByTheLatestRevision) {
  for (const char* name : {"a", "b", "c", "d"}) ASSERT_TRUE(push(name, std::string(name) + "\n"));
  ASSERT_TRUE(describe("a", {.part = "1", .operation = "10"}));
  ASSERT_TRUE(describe("b", {.part = "1", .operation = "20"}));
  ASSERT_TRUE(describe("c", {.part = "2", .operation = "10", .machine_group = kAllMachines}));
  EXPECT_EQ(listed({}), "a b c d ");
  EXPECT_EQ(listed({.part = "1"}), "a b ");
  EXPECT_EQ(listed({.part = "1", .operation = "20"}), "b ");
  EXPECT_EQ(listed({.machine_group = kAllMachines}), "c ");
  EXPECT_EQ(listed({.part = ""}), "d ") << "not stated";
  EXPECT_EQ(listed({.control = "centurion", .author = "cam"}), "a b c d ");
  EXPECT_EQ(listed({.author = "stranger"}), "");
  EXPECT_EQ(listed({.state = RevisionState::Released}), "");
  EXPECT_EQ(listed({.after = "b"}), "c d ");
  EXPECT_EQ(listed({.part = "1", .after = "a"}, {.limit = 1, .offset = 0}), "b ");
  EXPECT_EQ(listed({}, {.limit = 2, .offset = 1}), "b c ");
  ASSERT_TRUE(store_->programs.remove("b"));
  EXPECT_EQ(listed({.part = "1"}), "a ");
  EXPECT_EQ(store_->programs.count(), 3u);
}

/// The columns that listings use follow whatever changes a revision.
TEST_P(FieldsTest, WhatIsListedIsWhatTheRevisionsAre) {
  ASSERT_TRUE(push("a", "M30\n"));
  Upload upload;
  upload.program = "a";
  upload.author = "machine m1";
  upload.is_held = true;
  const auto id = store_->uploads.begin(upload)->id;
  ASSERT_TRUE(store_->uploads.append(id, 0, bytes_of("M31\n")));
  ASSERT_TRUE(store_->uploads.commit(id, {}));
  const auto shown = [&] { return store_->programs.list({})->at(0); };
  EXPECT_EQ(shown().latest.number, 1u);
  EXPECT_EQ(shown().held, 1u);
  EXPECT_EQ(shown().revisions, 2u);
  ASSERT_TRUE(store_->programs.accept("a", 2, {}));
  EXPECT_EQ(shown().latest.number, 2u);
  EXPECT_EQ(shown().held, 0u);
  EXPECT_EQ(listed({.author = "machine m1"}), "a ");
  EXPECT_EQ(listed({.author = "cam"}), "");
  EXPECT_EQ(query("SELECT count(*) FROM program WHERE latest <> (SELECT max(number) FROM revision "
                  "WHERE program = program.id)"),
            0);
}

ON_BOTH_ENGINES(FieldsTest);

}  // namespace
}  // namespace dripline::storage
