// Samples that no endpoint of ours would write, from writers that spoil them on the way.
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

class Rejection : public Network {};

TEST_F(Rejection, TheServerDropsAndCountsWhatFailsItsCheck) {
  auto server = open_server();
  auto gateway = open_gateway("lathe-1");
  ASSERT_TRUE(server->announces.take());  // the server's reader of records is there
  Rogue<Record> rogue;
  rogue.open(options_, Role::Gateway, "lathe-1");
  // What a rogue wrote before the server knew it is lost, so this one says that it does.
  std::optional<Record> first;
  for (int tries = 0; !first && tries < 50; ++tries) {
    rogue.write(record("lathe-1", 1), [](auto&) {});
    first = server->records.take(200ms);
  }
  ASSERT_TRUE(first);
  rogue.write(record("lathe-1", 2), [](auto& sample) { sample.kind = 200; });
  rogue.write(record("lathe-2", 3), [](auto&) {});  // not this partition's machine
  rogue.write(record("lathe-1", 4), [](auto& sample) { sample.text[0] = '\xFF'; });
  rogue.write(record("lathe-1", 5), [](auto&) {});
  auto next = server->records.take();
  while (next && next->number == 1) next = server->records.take();
  ASSERT_TRUE(next);
  EXPECT_EQ(next->number, 5U);
  EXPECT_EQ(server->endpoint->rejected().messages, 3U);
  EXPECT_NE(server->endpoint->rejected().last_reason, "");
}

TEST_F(Rejection, TheGatewayDropsAndCountsBlocksWithAWrongCrc) {
  open_server();  // finds a free domain, then is gone
  auto gateway = open_gateway("lathe-1");
  Rogue<BlockData> rogue;
  rogue.open(options_, Role::Server, "lathe-1");
  std::optional<BlockData> first;
  for (int tries = 0; !first && tries < 50; ++tries) {
    rogue.write(block_data("lathe-1", 0, 10), [](auto&) {});
    first = gateway->blocks.take(200ms);
  }
  ASSERT_TRUE(first);
  rogue.write(block_data("lathe-1", 10, 10), [](auto& sample) { sample.crc ^= 1; });
  rogue.write(block_data("lathe-1", 20, 10), [](auto& sample) { sample.status = 77; });
  rogue.write(block_data("lathe-1", 30, 10), [](auto&) {});
  auto next = gateway->blocks.take();
  while (next && next->offset == 0) next = gateway->blocks.take();
  ASSERT_TRUE(next);
  EXPECT_EQ(next->offset, 30U);
  EXPECT_EQ(gateway->endpoint->rejected().messages, 2U);
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

}  // namespace
}  // namespace dripline::dds::test
