#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "tests/load/process_use.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/rest_client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::load {

struct ShopOptions {
  std::string server;    ///< dncd
  std::string store;     ///< URL of an empty database; empty: SQLite in its state folder
  std::string programs;  ///< folder of load_gateways
  std::size_t machines = 10;
  double changes = 5, records = 1;   ///< a second, of each machine
  std::uint32_t cells = 64;          ///< NetworkOptions::cells, of both ends
  std::uint32_t discovery_ms = 250;  ///< between two announcements of DDS, of both ends
  std::uint32_t lease_ms = 2000;     ///< likewise
  double feeding = 0.1;              ///< share of the machines that pull a program
};

/// What became of the records.
struct Kept {
  std::uint64_t sent = 0, stored = 0;
  std::uint64_t lost = 0;     ///< sent and not stored
  std::uint64_t damaged = 0;  ///< stored otherwise than sent, or never sent
  std::uint64_t text_bytes = 0, damaged_texts = 0, refused_statuses = 0;
};

/// One real server and many gateways of the load, on loopback, in a folder of their own. What fails
/// ends the process with a word.
class Shop {
 public:
  explicit Shop(ShopOptions options);

  void start_server();
  void kill_server();
  void start_gateways();
  /// Until the server says that all are connected; returns the seconds this took.
  double wait_connected();
  /// What the machines run.
  void push_program();
  /// On every machine; one that is refused, as by a busy server, is tried again for a minute.
  void start_runs();
  /// No more records; until all are acknowledged, then compares them with the server's database.
  Kept drain();

  const std::string& url() const { return url_; }
  const std::string& token() const { return token_; }
  ProcessUse server_use() const { return use_of(server_->pid()); }
  ProcessUse gateways_use() const;

 private:
  std::size_t connected() const;
  test_support::RestClient rest() const { return {url_, token_}; }

  ShopOptions options_;
  test_support::TemporaryFolder folder_;
  int domain_ = 0;
  std::optional<FileLock> domain_lock_;
  std::string tag_, url_, token_;
  std::optional<test_support::ChildProcess> server_;
  std::vector<test_support::ChildProcess> gateways_;
};

}  // namespace dripline::load
