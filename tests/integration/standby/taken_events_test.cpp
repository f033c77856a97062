// Webhooks, hot folders and MTConnect, when the server that serves them ends.
#include <httplib.h>
#include <condition_variable>
#include <fstream>

#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::eventually;

/// Of webhooks. It can keep the first delivery waiting, so that its sender cannot know that it
/// came.
class Deliveries {
 public:
  struct Delivery {
    std::string id;
    std::uint64_t number = 0;
    std::string body;
  };
  Deliveries() {
    server_.Post("/", [this](const httplib::Request& request, httplib::Response& response) {
      std::unique_lock lock(mutex_);
      all_.push_back({request.get_header_value("Dripline-Delivery"),
                      json::parse(request.body, nullptr, false).value("number", std::uint64_t{0}),
                      request.body});
      changed_.wait_for(lock, std::chrono::seconds(20), [&] { return !is_held_; });
      response.status = 200;
    });
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) test_support::wait_a_little();
  }
  ~Deliveries() {
    release();
    server_.stop();
    thread_.join();
  }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/"; }
  std::vector<Delivery> all() {
    const std::lock_guard lock(mutex_);
    return all_;
  }
  void release() {
    {
      const std::lock_guard lock(mutex_);
      is_held_ = false;
    }
    changed_.notify_all();
  }

 private:
  httplib::Server server_;
  int port_ = 0;
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_held_ = true;
  std::vector<Delivery> all_;
};

class TakenEvents : public TwoServersTest {
 protected:
  /// Both servers with these settings.
  void begin_with(const std::string& toml) {
    const auto file = folder_.path() / "dncd.toml";
    std::ofstream(file) << toml;
    begin({"--config=" + file.string()});
  }
  const test_support::TemporaryFolder folder_;
};

TEST_F(TakenEvents, OfAWebhookComeAgainWithTheSameIdAndNoneIsLost) {
  Deliveries receiver;
  begin();
  const auto added =
      shop_->rest(0).post("/api/v1/webhooks", {{"name", "erp"}, {"url", receiver.url()}});
  ASSERT_EQ(added.status, 201) << added.body;
  for (int number = 1; number <= 3; ++number)
    shop_->push(0, "O" + std::to_string(number), "O1\nM30\n");
  ASSERT_TRUE(eventually([&] { return receiver.all().size() == 1; })) << "and is not answered";
  shop_->server(0).kill();
  ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
  receiver.release();
  shop_->push(1, "O4", "O1\nM30\n");
  ASSERT_TRUE(
      eventually([&] { return !receiver.all().empty() && receiver.all().back().number == 4; }));
  const auto all = receiver.all();
  ASSERT_EQ(all.size(), 5u) << "the first one twice";
  EXPECT_EQ(all[1].id, all[0].id);
  EXPECT_EQ(all[1].body, all[0].body);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_EQ(all[i].number, i);
}

TEST_F(TakenEvents, FilesOfAHotFolderAreTakenOnce) {
  const fs::path folder = folder_.path() / "cam";
  fs::create_directories(folder);
  begin_with("[[folder]]\nname = \"cam\"\npath = \"" + folder.string() +
             "\"\ncontrol = \"fanuc\"\nunchanged_seconds = 0\npoll_seconds = 1\n[[folder.rule]]\n"
             "matches = '(?P<program>P\\d+)\\.nc'\nprogram = \"{program}\"\n");
  constexpr int kFiles = 40;
  for (int number = 1; number <= kFiles; ++number) {
    std::ofstream(folder / fmt::format("P{}.nc", number)) << "O1\nG0 X" << number << ".\nM30\n";
    if (number == kFiles / 2) shop_->server(0).kill();
  }
  ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
  const auto is_empty = [&] {
    return std::ranges::none_of(fs::directory_iterator(folder),
                                [](const auto& entry) { return entry.is_regular_file(); });
  };
  ASSERT_TRUE(eventually(is_empty));
  for (int number = 1; number <= kFiles; ++number) {
    const auto known = shop_->rest(1).get(fmt::format("/api/v1/programs/P{}", number)).json();
    ASSERT_EQ(known.value("revisions", json::array()).size(), 1u) << number << known;
  }
}

std::string attribute(const std::string& document, const std::string& name) {
  const auto at = document.find(name + "=\"");
  if (at == std::string::npos) return "";
  const auto begin = at + name.size() + 2;
  return document.substr(begin, document.find('"', begin) - begin);
}

/// A reader that sees another instanceId begins again at the first sequence.
TEST_F(TakenEvents, TheAgentOfTheOtherServerIsAnotherInstanceOfTheSameDevices) {
  begin({"--mtconnect=127.0.0.1:0"});
  shop_->start_gateway();
  ASSERT_TRUE(shop_->wait_connected(0));
  const auto ask = [&](int server, const std::string& path) {
    const std::string out = shop_->output(server), words = "MTConnect agent at ";
    const auto at = out.rfind(words);
    if (at == std::string::npos) return std::string();
    const auto begin = at + words.size();
    return test_support::RestClient(out.substr(begin, out.find('\n', begin) - begin), "")
        .get(path)
        .body;
  };
  const auto first = ask(0, "/current");
  EXPECT_EQ(ask(1, "/current"), "") << "a server that waits has no agent";
  shop_->server(0).kill();
  ASSERT_TRUE(eventually([&] { return !ask(1, "/current").empty(); })) << shop_->log(1);
  const auto second = ask(1, "/current");
  ASSERT_NE(attribute(first, "instanceId"), "");
  EXPECT_GT(attribute(second, "instanceId"), attribute(first, "instanceId"));
  EXPECT_EQ(attribute(second, "firstSequence"), "1") << second;
  EXPECT_EQ(attribute(ask(1, "/probe"), "uuid"), attribute(first, "uuid"));
}

}  // namespace
}  // namespace dripline::integration
