// Samples that no endpoint would write, from writers that damage them.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "network.hpp"
#include "protocol/dds/impl/domain.hpp"
#include "protocol/dds/impl/writer.hpp"

namespace dripline::dds::test {
namespace {

/// A participant with one writer in one machine's partition.
template <class Message>
struct Rogue {
  Domain domain;
  Entity topic, publisher;
  Inbox<bool> matched;
  std::unique_ptr<Writer<Message>> writer;

  void open(const NetworkOptions& options, Role role, const std::string& machine) {
    domain = open_domain(options, role, cell_of(machine)).value();
    topic = create_topic<Message>(domain).value();
    const Qos partition = partition_qos(partition_of(machine));
    publisher = Entity(dds_create_publisher(domain.participant.get(), partition.get(), nullptr));
    writer = Writer<Message>::create(publisher, topic, [this] { matched.put(true); }).value();
    ASSERT_TRUE(matched.take());
  }
  template <class Spoil>
  void write(const Message& message, Spoil spoil) {
    ASSERT_TRUE(writer->write(message, spoil));
  }
};

class Rejection : public Network {
 protected:
  /// Writes until the other side has refused it: what is written before both know each other is
  /// lost.
  template <class Message, class Endpoint>
  static void write_until_refused(Rogue<Message>& rogue, const Message& message,
                                  Endpoint& endpoint) {
    const auto before = endpoint.rejected().messages;
    for (int tries = 0; tries < 200 && endpoint.rejected().messages == before; ++tries) {
      rogue.write(message, [](auto&) {});
      std::this_thread::sleep_for(20ms);
    }
    ASSERT_GT(endpoint.rejected().messages, before);
  }
};

std::set<std::uint16_t> udp_ports_of_this_process() {
  std::set<std::string> inodes;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code ec;
    const auto target = std::filesystem::read_symlink(entry.path(), ec).string();
    if (target.starts_with("socket:[")) inodes.insert(target.substr(8, target.size() - 9));
  }
  std::set<std::uint16_t> ports;
  std::ifstream table("/proc/self/net/udp");
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::istringstream words(line);
    std::string number, local, word, inode;
    words >> number >> local;
    for (int i = 0; i < 8 && words >> word; ++i) inode = word;
    if (inodes.contains(inode))
      ports.insert(static_cast<std::uint16_t>(std::stoul(local.substr(9), nullptr, 16)));
  }
  return ports;
}

TEST_F(Rejection, TheServerDropsAndCountsWhatFailsItsCheckOrComesFromOthers) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_TRUE(server->announces.take());  // the server's reader of records is there
  Rogue<Record> rogue;
  rogue.open(options_, Role::Gateway, "lathe-1");
  write_until_refused(rogue, record("lathe-1", 1), *server->endpoint);
  const auto before = server->endpoint->rejected().messages;
  rogue.write(record("lathe-1", 2), [](auto& sample) { sample.kind = 200; });
  rogue.write(record("lathe-2", 3), [](auto&) {});  // not this partition's machine
  rogue.write(record("lathe-1", 4), [](auto& sample) { sample.text[0] = '\xFF'; });
  while (server->endpoint->rejected().messages < before + 3) std::this_thread::sleep_for(5ms);
  EXPECT_NE(server->endpoint->rejected().last_reason.find("text"), std::string::npos)
      << server->endpoint->rejected().last_reason;
  ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", 5)));
  EXPECT_EQ(server->records.take().value().number, 5U) << "the first that was delivered";
}

TEST_F(Rejection, ServerMessagesAreAcceptedFromItsParticipantOnly) {
  auto server = open_server();
  Rogue<Status> status;
  Rogue<CommandResult> result;
  Rogue<BlockRequest> request;
  auto gateway = open_gateway("lathe-1");
  ASSERT_TRUE(server->announces.take());
  status.open(options_, Role::Gateway, "lathe-1");
  result.open(options_, Role::Gateway, "lathe-1");
  request.open(options_, Role::Gateway, "lathe-1");
  Status forged;
  forged.machine = "lathe-1";
  forged.message = "MACHINE IS OK, GO IN";
  write_until_refused(status, forged, *server->endpoint);
  write_until_refused(result, {"lathe-1", "order-1", true, ""}, *server->endpoint);
  write_until_refused(request, {"lathe-1", 1, "run-1", "", 0, 100}, *server->endpoint);
  EXPECT_EQ(server->statuses.size(), 0U);
  EXPECT_EQ(server->results.size(), 0U);
  EXPECT_EQ(server->requests.size(), 0U);
  EXPECT_EQ(server->rivals.size(), 0U) << "it announced nothing";
}

/// A second participant that speaks straight to the gateway's port while the server lives.
TEST_F(Rejection, TheGatewayTakesOrdersTextAndAcksFromItsServerOnly) {
  auto server = open_server();
  const auto before = udp_ports_of_this_process();
  auto gateway = open_gateway("lathe-1");
  ASSERT_EQ(gateway->server.take(), true);
  NetworkOptions options = options_;
  const auto aim_at = [&](std::uint16_t port) {
    options.server = fmt::format("127.0.0.1:{}", port - 2 * cell_of("lathe-1"));
  };
  std::vector<std::uint16_t> own;
  std::ranges::set_difference(udp_ports_of_this_process(), before, std::back_inserter(own));
  ASSERT_FALSE(own.empty());
  aim_at(own.front());

  Command start;
  start.machine = "lathe-1";
  start.id = "forged";
  start.action = CommandAction::Start;
  start.run = "run-1";
  start.program = "O1";
  start.revision = std::string(64, 'a');
  Rogue<Command> commands;
  commands.open(options, Role::Gateway, "lathe-1");
  write_until_refused(commands, start, *gateway->endpoint);
  Command hold = start;
  hold.action = CommandAction::Hold;
  write_until_refused(commands, hold, *gateway->endpoint);
  Rogue<BlockData> blocks;
  blocks.open(options, Role::Gateway, "lathe-1");
  write_until_refused(blocks, block_data("lathe-1", 0, 10), *gateway->endpoint);
  Rogue<RecordAck> acks;
  acks.open(options, Role::Gateway, "lathe-1");
  write_until_refused(acks, RecordAck{"lathe-1", 7, 1}, *gateway->endpoint);
  EXPECT_EQ(gateway->commands.size(), 0U);
  EXPECT_EQ(gateway->blocks.size(), 0U);
  EXPECT_EQ(gateway->acks.size(), 0U);

  start.id = "from the server";
  std::ranges::replace(start.id, ' ', '-');
  ASSERT_TRUE(server->endpoint->write(start));
  EXPECT_EQ(gateway->commands.take(), start);
}

TEST_F(Rejection, AGatewayWithoutAServerDropsEverything) {
  open_server();  // finds a free domain, then is gone
  auto gateway = open_gateway("lathe-1");
  Rogue<BlockData> rogue;
  rogue.open(options_, Role::Server, "lathe-1");
  write_until_refused(rogue, block_data("lathe-1", 0, 10), *gateway->endpoint);
  EXPECT_EQ(gateway->blocks.size(), 0U);
}

TEST_F(Rejection, AnAnnouncementInAnotherMachinesPartitionAttachesNothing) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_TRUE(server->announces.take());
  Rogue<Announce> rogue;
  rogue.open(options_, Role::Gateway, "lathe-1");
  rogue.write(announce("lathe-2"), [](auto&) {});  // transient-local: not lost
  Announce changed = announce("lathe-1", 2);       // handled after it, on the same thread
  while (server->endpoint->rejected().messages == 0) {
    ++changed.session;
    ASSERT_TRUE(gateway->endpoint->write(changed));
    ASSERT_EQ(server->announces.take(), changed);
  }
  EXPECT_EQ(server->endpoint->write(RecordAck{"lathe-2", 1, 1}).error().code, Errc::NotFound);
}

/// Each machine attached costs memory; a participant gets one.
TEST_F(Rejection, OneParticipantDoesNotAnnounceThousandsOfMachines) {
  auto server = open_server();
  constexpr std::uint32_t kMachines = 2000;
  Domain domain = open_domain(options_, Role::Gateway, 0).value();
  const Entity topic = create_topic<Announce>(domain).value();
  std::vector<Entity> publishers;
  std::vector<std::unique_ptr<Writer<Announce>>> writers;
  std::uint64_t announced = 0;
  for (std::uint32_t i = 0; announced < kMachines; ++i) {
    const std::string machine = fmt::format("invented-{}", i);
    if (cell_of(machine) != 0) continue;
    ++announced;
    const Qos partition = partition_qos(partition_of(machine));
    publishers.emplace_back(
        dds_create_publisher(domain.participant.get(), partition.get(), nullptr));
    writers.push_back(Writer<Announce>::create(publishers.back(), topic, [] {}).value());
    ASSERT_TRUE(writers.back()->write(announce(machine), [](auto&) {}));
  }
  const auto limit = std::chrono::steady_clock::now() + 60s;
  while (server->endpoint->rejected().messages < kMachines - 1 &&
         std::chrono::steady_clock::now() < limit) {
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_GE(server->endpoint->rejected().messages, kMachines - 1);
  EXPECT_NE(server->endpoint->rejected().last_reason.find("one participant"), std::string::npos);
}

}  // namespace
}  // namespace dripline::dds::test
