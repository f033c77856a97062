#include <gtest/gtest.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "protocol/archive/archive_reader.hpp"
#include "protocol/archive/archive_writer.hpp"
#include "protocol/audit/trail_file.hpp"
#include "protocol/measurement/measurement_json.hpp"
#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::Dnc;

/// What retention moved into files, read without a server.
class DncArchive : public testing::Test {
 protected:
  archive::WrittenFile write(const std::string& name, const std::string& kind,
                             const std::vector<json>& rows) const {
    auto writer = archive::ArchiveWriter::begin(
        dnc.folder() / name, {kind, kind == "records" ? "lathe-1" : "", "db", "test"});
    EXPECT_TRUE(writer) << writer.error().what;
    for (const json& row : rows) EXPECT_TRUE(writer->add(row.dump()));
    const auto written = writer->end();
    EXPECT_TRUE(written) << written.error().what;
    return *written;
  }
  /// Parts 1 to 4 of a value each; part 2 was derived again as part 4.
  archive::WrittenFile write_measurements() const {
    std::vector<json> rows;
    for (std::uint64_t id = 1; id <= 4; ++id) {
      measurement::Measurement one;
      one.id = id;
      one.machine = id == 3 ? "lathe-2" : "lathe-1";
      one.run = "3f9c0000";
      one.part_id = id;
      one.serial = id == 1 ? "=1+1" : "S7";
      one.characteristic = {id == 3 ? "L" : "D12", 40.0, 39.98, 40.02, "mm", 3};
      one.actual = 40 + 0.01 * static_cast<double>(id);
      one.time = UtcTime(std::chrono::hours(24 * 20000 + (id == 4 ? 2 : id)));
      one.record = {7, id};
      one.verdict = measurement::judge(one.characteristic, one.actual, {});
      rows.push_back({{"part", {{"id", id}, {"superseded", id == 2}}}});
      rows.push_back({{"measurement", measurement::to_json(one)}});
    }
    return write("m.jsonl.zst", "measurements", rows);
  }
  void write_records() const {
    std::vector<json> rows;
    const auto add = [&](const char* kind, const json& run, const char* text) {
      rows.push_back({{"machine", "lathe-1"},
                      {"epoch", 7},
                      {"number", rows.size() + 1},
                      {"time", "2026-11-21T07:40:06Z"},
                      {"run", run},
                      {"kind", kind},
                      {"block", 3},
                      {"line", 4},
                      {"sequence", nullptr},
                      {"device", "port1"},
                      {"text", text},
                      {"received", nullptr}});
    };
    add("output", "3f9c0000", "D 40.010");
    add("alarm", "3f9c0000", "E-STOP");
    add("output", "3f9c0000", "D\x1b[2J");
    add("output", "3fa00000", "D 41");
    add("output", nullptr, "NO RUN");
    write("r.jsonl.zst", "records", rows);
  }
  test_support::DncResult measurements(std::vector<std::string> more) const {
    std::vector<std::string> all{"report", "measurements", "--archive", "m.jsonl.zst"};
    all.insert(all.end(), more.begin(), more.end());
    return dnc(all);
  }
  /// Its rows are another's, its end is not.
  void forge(const std::string& name, std::size_t at) const {
    std::fstream bytes(dnc.folder() / name, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekg(static_cast<std::streamoff>(at));
    const int was = bytes.get();
    bytes.seekp(static_cast<std::streamoff>(at));
    bytes.put(static_cast<char>(was ^ 0x20));
  }
  Dnc dnc{DNC_PATH};
};

TEST_F(DncArchive, ListsMeasurementsAsTheServerDoes) {
  write_measurements();
  const auto listed = measurements({"--json"});
  ASSERT_EQ(listed.status, 0) << listed.err;
  const json all = json::parse(listed.out);
  ASSERT_EQ(all.at("measurements").size(), 3U) << "one was derived again";
  EXPECT_TRUE(all.at("next").is_null());
  EXPECT_EQ(all["measurements"][1]["id"], 4) << "by time";
  EXPECT_EQ(all["measurements"][0]["deviation"], 40.01 - 40);
  EXPECT_EQ(json::parse(measurements({"--json", "--superseded"}).out)["measurements"].size(), 4U);
  EXPECT_EQ(json::parse(
                measurements({"--json", "--newest", "--limit", "1"}).out)["measurements"][0]["id"],
            3);
  EXPECT_NE(measurements({}).out.find("D12"), std::string::npos);
  EXPECT_EQ(measurements({"--machine", "absent"}).out, "Nothing was measured.\n");
}

TEST_F(DncArchive, TakesWhatIsAskedFor) {
  write_measurements();
  const auto ids = [&](std::vector<std::string> filter) {
    filter.emplace_back("--json");
    const auto listed = measurements(filter);
    EXPECT_EQ(listed.status, 0) << listed.err;
    std::vector<int> found;
    const json shown = json::parse(listed.out);
    for (const auto& one : shown.at("measurements")) found.push_back(one["id"]);
    return found;
  };
  EXPECT_EQ(ids({"--machine", "lathe-2"}), std::vector<int>{3});
  EXPECT_EQ(ids({"--characteristic", "D12"}), (std::vector<int>{1, 4}));
  EXPECT_EQ(ids({"--run", "3f9"}), (std::vector<int>{1, 4, 3}));
  EXPECT_EQ(ids({"--run", "4"}), std::vector<int>{});
  EXPECT_EQ(ids({"--verdict", "scrap"}), (std::vector<int>{4, 3}));
  EXPECT_EQ(ids({"--since", "2024-10-04T02:00:00Z"}), (std::vector<int>{4, 3}));
  EXPECT_EQ(ids({"--until", "2024-10-04T02:00:00Z"}), std::vector<int>{1});
  EXPECT_NE(measurements({"--since", "yesterday"}).status, 0);
  EXPECT_NE(measurements({"--run", "latest"}).err.find("--run latest needs the server"),
            std::string::npos);
}

TEST_F(DncArchive, WritesCsvAndJsonLinesToFilesAndOutput) {
  write_measurements();
  auto done = measurements({"--csv", "-o", "d.csv"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.out, "");
  const std::string csv = dnc.read("d.csv");
  EXPECT_TRUE(csv.starts_with("id,time,machine,")) << csv;
  EXPECT_NE(csv.find(",'=1+1,"), std::string::npos) << csv;
  EXPECT_EQ(std::ranges::count(csv, '\n'), 4);
  EXPECT_EQ(measurements({"--csv"}).out, csv);
  EXPECT_EQ(measurements({"--csv", "-o", "-"}).out, csv);
  done = measurements({"-o", "d.jsonl", "--characteristic", "L"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(json::parse(dnc.read("d.jsonl"))["machine"], "lathe-2");
  done = measurements({"--csv", "--json"});
  EXPECT_EQ(done.status, 2);
  EXPECT_NE(done.err.find("--csv and --json"), std::string::npos);
  done = measurements({"--csv", "--newest"});
  EXPECT_EQ(done.status, 2);
  EXPECT_NE(done.err.find("--newest"), std::string::npos);
}

TEST_F(DncArchive, IsAFileOfMeasurementsForEveryVerb) {
  write_measurements();
  const auto drawn =
      dnc({"report", "chart", "trend", "m.jsonl.zst", "--characteristic", "D12", "-o", "-"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(drawn.out.find("2 values"), std::string::npos);
  const auto made = dnc({"report", "export", "--from", "m.jsonl.zst", "--format", "dfq"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_TRUE(made.out.starts_with("K0100 "));
}

TEST_F(DncArchive, ShowsTheLinesOfARunOrOfAMachine) {
  write_records();
  const auto show = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"report", "show", "--archive", "r.jsonl.zst"});
    return dnc(more);
  };
  EXPECT_EQ(show({"3f9c"}).out, "D 40.010\nD\x1b[2J\n") << "a pipe gets the lines as they were";
  EXPECT_EQ(show({"lathe-1"}).out, "NO RUN\n");
  const json shown = json::parse(show({"3f9c", "--json"}).out);
  EXPECT_EQ(shown["run"], "3f9c0000");
  EXPECT_EQ(shown["machine"], "lathe-1");
  ASSERT_EQ(shown["lines"].size(), 2U);
  EXPECT_EQ(shown["lines"][0]["text"], "D 40.010");
  auto refused = show({"3f"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("3f9c0000 and 3fa00000"), std::string::npos) << refused.err;
  EXPECT_NE(show({"latest"}).err.find("latest needs the server"), std::string::npos);
  refused = show({"77"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("no record of run or machine 77"), std::string::npos) << refused.err;
  refused = dnc({"report", "measurements", "--archive", "r.jsonl.zst"});
  EXPECT_NE(refused.err.find("holds records, not measurements"), std::string::npos);
}

/// Whatever byte is changed or cut off: nothing is printed, nothing is written.
TEST_F(DncArchive, OfWhichAByteWasChangedPrintsNothing) {
  write_measurements();
  write_records();
  for (const char* name : {"m.jsonl.zst", "r.jsonl.zst"}) {
    const std::string whole = dnc.read(name);
    for (std::size_t at = 6; at < whole.size(); at += 23) {
      for (const bool is_cut : {false, true}) {
        dnc.write(name, is_cut ? whole.substr(0, at) : whole);
        if (!is_cut) forge(name, at);
        const auto result = name[0] == 'm' ? measurements({"--csv", "-o", "out.csv"})
                                           : dnc({"report", "show", "3f9c", "--archive", name});
        // zstd ignores some bits of its head; a file whose rows are unchanged may be read.
        if (result.status == 0) continue;
        EXPECT_EQ(result.out, "") << name << " " << at;
        EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
        EXPECT_FALSE(std::filesystem::exists(dnc.folder() / "out.csv") && name[0] == 'm' &&
                     dnc.read("out.csv").size() < 100);
      }
    }
    dnc.write(name, whole);
  }
}

/// Rows of a forger, compressed again under the old end: as many rows as there were.
TEST_F(DncArchive, WithForgedRowsPrintsNoneOfThem) {
  const json row{{"machine", "lathe-1"},
                 {"run", "3f9c"},
                 {"kind", "output"},
                 {"text", "FORGED"},
                 {"device", "port1"}};
  auto writer = archive::ArchiveWriter::begin(dnc.folder() / "f.jsonl.zst",
                                              {"records", "lathe-1", "db", "test"});
  ASSERT_TRUE(writer);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(writer->add(row.dump()));
  ASSERT_TRUE(writer->add(R"({"end":3,"sha256":")" + std::string(64, '0') + "\"}"));
  ASSERT_TRUE(writer->end());
  for (const auto& more : {std::vector<std::string>{}, std::vector<std::string>{"--json"}}) {
    std::vector<std::string> words{"report", "show", "3f9c", "--archive", "f.jsonl.zst"};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = dnc(words);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find("its rows do not fit its end"), std::string::npos) << result.err;
  }
}

/// A whole new file fits itself; the server's list has another digest.
TEST_F(DncArchive, IsRefusedIfItIsNotTheFileThatWasListed) {
  const std::string sha256 = write_measurements().sha256.hex();
  EXPECT_EQ(measurements({"--sha256", sha256.substr(0, 12)}).status, 0);
  auto refused = measurements({"--sha256", std::string(12, '0')});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_NE(refused.err.find("its SHA-256 is " + sha256), std::string::npos) << refused.err;
  refused = measurements({"--sha256", "latest"});
  EXPECT_NE(refused.err.find("8 to 64 hexadecimal digits"), std::string::npos) << refused.err;
  refused = dnc({"report", "measurements", "--sha256", sha256});
  EXPECT_NE(refused.err.find("--archive FILE"), std::string::npos) << refused.err;
}

/// An exported trail and a copy of the folder are enough.
TEST_F(DncArchive, AreVerifiedAgainstAnExportedTrail) {
  const std::string sha256 = write_measurements().sha256.hex();
  const SigningKey key = SigningKey::of(std::string(64, '7')).value();
  const audit::Entry entry{.number = 1,
                           .time = UtcTime(std::chrono::hours(24 * 20000)),
                           .who = "retention",
                           .credential = {},
                           .address = {},
                           .action = "archive.create",
                           .subject = "m.jsonl.zst",
                           .detail = "8 measurements, sha256 " + sha256};
  const Digest digest = audit::chain_next(audit::chain_begin("db"), audit::line_of(entry));
  audit::Checkpoint checkpoint{
      .number = 1, .entry = 1, .time = entry.time, .digest = digest, .signature = {}};
  checkpoint.signature = key.sign(audit::checkpoint_text(checkpoint, "db"));
  dnc.write("trail.txt", audit::header_line({"db", key.public_key()}) +
                             audit::entry_line(entry, digest) + audit::checkpoint_line(checkpoint) +
                             audit::end_line(1));
  auto verified = dnc({"audit", "verify", "trail.txt", "--archives", "."});
  EXPECT_EQ(verified.status, 0) << verified.err;
  EXPECT_NE(verified.out.find("1 archives, each as it was written."), std::string::npos)
      << verified.out;
  forge("m.jsonl.zst", 40);
  verified = dnc({"audit", "verify", "trail.txt", "--archives", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_NE(verified.err.find("archive m.jsonl.zst: it was changed: its SHA-256 is "),
            std::string::npos)
      << verified.err;
  std::filesystem::remove(dnc.folder() / "m.jsonl.zst");
  verified = dnc({"audit", "verify", "trail.txt", "--archives", "."});
  EXPECT_EQ(verified.status, 1);
  EXPECT_NE(verified.err.find("archive m.jsonl.zst: it cannot be opened"), std::string::npos)
      << verified.err;
  EXPECT_EQ(dnc({"audit", "verify", "--archives", "."}).status, 2);
}

}  // namespace
}  // namespace dripline
