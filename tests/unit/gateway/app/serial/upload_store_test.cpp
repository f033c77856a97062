#include "gateway/app/serial/upload_store.hpp"

#include <gtest/gtest.h>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace dripline::gateway {
namespace {

class UploadStoreTest : public testing::Test {
 protected:
  UploadStore open() {
    auto store = UploadStore::open(folder_.path() / "uploads");
    EXPECT_TRUE(store) << store.error().what;
    return *std::move(store);
  }
  test_support::TemporaryFolder folder_;
};

TEST_F(UploadStoreTest, KeepsAProgramUntilTheServerHasIt) {
  {
    UploadStore store = open();
    store.begin("1-1");
    store.append("O15\nG0 X");
    store.append("1.\nM30\n");
    const auto upload = store.finish("O15");
    ASSERT_TRUE(upload) << upload.error().what;
    EXPECT_EQ(upload->size, 15U);
    EXPECT_EQ(upload->content, sha256("O15\nG0 X1.\nM30\n").hex());
    store.begin("1-2");
    store.append("O16\n");  // cut off by a kill
  }
  UploadStore store = open();
  ASSERT_EQ(store.waiting().size(), 1U);
  EXPECT_EQ(store.waiting().front().name, "O15");
  EXPECT_EQ(store.read("1-1", 4, 5).value(), "G0 X1");
  EXPECT_EQ(store.read("1-1", 15, 100).value(), "");
  EXPECT_FALSE(store.read("1-2", 0, 1));
  store.remove("1-1");
  EXPECT_TRUE(store.waiting().empty());
  EXPECT_TRUE(open().waiting().empty());
}

TEST_F(UploadStoreTest, GivesThemInTheirOrderAndNamesWhatWasDamaged) {
  UploadStore store = open();
  for (const char* id : {"1-1", "1-2"}) {
    store.begin(id);
    store.damage("parity at byte 7");
    store.append(id);
    ASSERT_TRUE(store.finish(""));
  }
  const UploadStore again = open();
  ASSERT_EQ(again.waiting().size(), 2U);
  EXPECT_EQ(again.waiting().front().id, "1-1");
  EXPECT_EQ(again.waiting().front().damage, "parity at byte 7");
}

TEST_F(UploadStoreTest, RefusesWhatIsEmptyOrTooMuch) {
  UploadStore store = open();
  store.begin("1");
  EXPECT_EQ(store.finish("O1").error().code, Errc::Syntax);
  for (std::size_t i = 0; i < UploadStore::kMaxUploads; ++i) {
    store.begin(std::to_string(i));
    store.append("M30\n");
    ASSERT_TRUE(store.finish("O1"));
  }
  store.begin("last");
  store.append("M30\n");
  EXPECT_EQ(store.finish("O1").error().code, Errc::LimitExceeded);
  EXPECT_EQ(store.waiting().size(), UploadStore::kMaxUploads);
}

TEST_F(UploadStoreTest, DropsWhatIsDamagedOnDisk) {
  {
    UploadStore store = open();
    store.begin("1-1");
    store.append("O15\nM30\n");
    ASSERT_TRUE(store.finish("O15"));
  }
  std::filesystem::resize_file(folder_.path() / "uploads" / "1-1.nc", 3);
  EXPECT_TRUE(open().waiting().empty());
}

/// Ids come from the network.
TEST_F(UploadStoreTest, TouchesNothingOutsideItsFolder) {
  UploadStore store = open();
  std::ofstream(folder_.path() / "other.nc") << "O1";
  store.remove("../other");
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "other.nc"));
  EXPECT_EQ(store.read("../other", 0, 2).error().code, Errc::NotFound);
}

TEST_F(UploadStoreTest, DropsATextWhoseNoteAKillHasPrevented) {
  (void)open();
  std::ofstream(folder_.path() / "uploads" / "1-1.nc") << "O15\nM30\n";
  EXPECT_TRUE(open().waiting().empty());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "uploads" / "1-1.nc"));
}

}  // namespace
}  // namespace dripline::gateway
