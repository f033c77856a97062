#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dripline::test_support {

/// A Dripline server's REST face in this process, with memory instead of a store and with faults on
/// order. Everything may be called from any thread.
class FakeServer {
 public:
  static constexpr const char* kToken = "right-token";

  FakeServer();
  ~FakeServer();
  std::string url() const;

  /// Faults, taken by the next requests of their kind, in order.
  struct PieceFault {
    std::size_t keep = 0;  ///< bytes of the piece that are stored
    int status = 0;        ///< answer with this error, or cut the connection when 0
    std::string code;      ///< of the error
    bool drops_upload = false;
  };
  void fail_piece(PieceFault fault);
  /// The commit happens, but its answer is lost.
  void lose_commit_answer();
  /// Cuts the next `times` answers with content after half of it.
  void cut_content(int times);
  /// The byte at `offset` of any content cannot be read: an answer that begins within 64 KiB
  /// before it is refused as corrupt, one that comes to it later breaks off.
  void damage_content_at(std::size_t offset);
  /// Stored content changes after the server's digest.
  void corrupt_content(const std::string& program);
  void cut_events_once();

  void add_program(const std::string& name, const std::string& content);
  /// The newest revision's content; empty when there is none.
  std::string content(const std::string& name) const;
  std::uint64_t revisions(const std::string& name) const;
  int pieces_received() const;
  std::size_t longest_piece() const;
  int uploads_open() const;

  /// Runs and machines are given and answered as JSON; a run replaces one of the same id.
  void set_run(const nlohmann::json& run);
  void set_machine(const nlohmann::json& machine);
  /// Sends an event to those who listen.
  void publish(const std::string& name, const nlohmann::json& data);
  /// Answers "METHOD PATH" with this body; of /ports..., /port-templates, setups, records and the
  /// judgment of revisions nothing is answered otherwise.
  void set_answer(const std::string& call, int status, const std::string& body);
  void set_answer(const std::string& call, const nlohmann::json& body) {
    set_answer(call, 200, body.dump());
  }
  /// The calls of that kind so far: "METHOD PATH BODY", of setups with the query.
  std::vector<std::string> calls() const;

  /// Called with each start and each order; gives the answer's status and body.
  void on_command(std::function<void(const std::string& run, const nlohmann::json& body)> handler);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dripline::test_support
