#pragma once

#include <httplib.h>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/clients/support/fake_server.hpp"

namespace dripline::test_support {

/// The programs and uploads of a FakeServer, their routes and their faults. The mutex is the
/// server's; who uses a member has taken it.
class FakeLibrary {
 public:
  explicit FakeLibrary(std::mutex& server_mutex) : mutex(server_mutex) {}
  void add_routes(httplib::Server& server);
  /// The number of the new revision.
  std::uint64_t add(const std::string& name, const std::string& content);

  struct StoredUpload {
    std::string program, bytes;
  };
  std::mutex& mutex;
  std::map<std::string, std::vector<std::string>> programs;
  std::map<std::string, std::string> digests;  ///< by program and number, as first stored
  std::map<std::string, StoredUpload> uploads;
  std::deque<FakeServer::PieceFault> piece_faults;
  bool loses_commit = false;
  int content_cuts = 0, pieces = 0;
  std::optional<std::size_t> damage;
  std::size_t longest_piece = 0;

 private:
  void add_program_routes(httplib::Server& server);
  void add_upload_routes(httplib::Server& server);
  void list(const httplib::Request& request, httplib::Response& response);
  void show(const std::string& name, httplib::Response& response);
  void give_content(const httplib::Request& request, httplib::Response& response);
  void answer_upload(httplib::Response& response, int status, const std::string& id);
  void take_piece(const httplib::Request& request, httplib::Response& response);
  void commit(const httplib::Request& request, httplib::Response& response);

  int upload_count_ = 0;
};

}  // namespace dripline::test_support
