#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "storage/store.hpp"

namespace dripline::mqtt {

/// The records that are to be published, each machine's in its order, from a stored cursor that
/// only passes what was acknowledged. One thread.
class RecordFeed {
 public:
  struct Options {
    std::size_t window = 100;             ///< records at most in progress
    std::vector<std::string> kinds = {};  ///< empty: all
  };
  RecordFeed(const storage::Store& store, std::string reader, Options options)
      : store_(store), reader_(std::move(reader)), options_(std::move(options)) {}

  /// Hands a record to the connection and returns the message's number there.
  using Publish = std::function<Result<std::uint64_t>(const storage::Record&)>;

  /// A new connection: what is in progress is to be published again.
  void restart();
  /// Publishes what the window has room for. True: there may be more. Errors: those of the store
  /// and of `publish`, after which it is to be restarted.
  Result<bool> fill(const Publish& publish);
  /// The record of this message; nullopt: it is none of these.
  std::optional<storage::RecordCursor> acknowledge(std::uint64_t message);
  /// Stores the cursors, as far as everything before them is acknowledged.
  Result<void> commit();

  std::size_t under_way() const { return under_way_.size(); }
  /// The message whose acknowledgment the cursors wait for; 0: none.
  std::uint64_t oldest() const { return under_way_.empty() ? 0 : under_way_.front().message; }
  /// Acknowledged, and not stored yet.
  bool has_uncommitted() const { return !passed_.empty(); }
  /// Records that were taken out of the database before they could be published.
  std::uint64_t missing() const { return missing_; }

 private:
  using Journal = std::pair<std::string, std::uint64_t>;  ///< machine, epoch
  struct Entry {
    storage::RecordCursor cursor;
    std::uint64_t message = 0;  ///< 0: none, it is not wanted
    std::uint64_t skipped = 0;  ///< numbers before it without a record
    bool is_done = false;
  };

  bool wants(const storage::Record& record) const;
  Result<bool> fill_from(const storage::UnreadRecords& journal, const Publish& publish);
  /// Up to which number the journal's records are in progress or beyond.
  std::uint64_t position(const storage::RecordCursor& read) const;
  void add(Entry entry);
  void pass();

  const storage::Store& store_;
  const std::string reader_;
  const Options options_;
  std::deque<Entry> under_way_;
  std::map<Journal, std::uint64_t> sent_;    ///< of journals with something in progress
  std::map<Journal, std::uint64_t> passed_;  ///< to be stored
  std::string last_machine_;                 ///< the others come first
  std::uint64_t missing_ = 0;
};

}  // namespace dripline::mqtt
