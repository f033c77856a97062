#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/feed/chunk_cache.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::feed {

/// A program that was called by name. Without both it was not found yet, or the server does not
/// state its content.
struct CalledProgram {
  std::string name;
  std::string content;      ///< SHA-256, hexadecimal
  bool is_missing = false;  ///< there is none of this name
  friend bool operator==(const CalledProgram&, const CalledProgram&) = default;
};

/// A run's text, and what its owner must know of its arrival. Functions that a kind of feed does
/// not need do nothing. One thread, the one that steps the interpreter.
class ProgramFeed : public interpreter::ProgramSource {
 public:
  /// An answer from the server. Anything that is not of this run and session is ignored.
  virtual void on_data(const dds::BlockData& /*data*/, SteadyTime /*now*/) {}
  /// Sends the requests that are due. Cheap when nothing is missing.
  virtual void poll(SteadyTime /*now*/) {}
  /// When poll has something to do without anything else happening; nullopt: never.
  virtual std::optional<SteadyTime> next_poll() const { return std::nullopt; }
  /// A server has (re)appeared: everything missing is requested at once.
  virtual void ask_again() {}
  /// The rate at which the text is used up; nullopt: as fast as possible.
  virtual void set_consumption(std::optional<double> /*bytes_per_second*/) {}

  /// What `find` was asked for, in the order of the indices from 1. A feed of the same run that is
  /// asked for them in this order gives the same indices.
  virtual std::vector<CalledProgram> called_programs() const { return {}; }
  virtual std::size_t called_program_count() const { return 0; }

  /// What is at hand around byte `offset`, at most `reach` bytes before and after it; empty when
  /// that byte is not. Nothing is requested for it.
  virtual HeldText held_around(interpreter::ProgramIndex /*program*/, std::uint64_t /*offset*/,
                               std::size_t /*reach*/) const {
    return {};
  }

  /// The *sent* counter: bytes of the main program received without a gap from its beginning.
  virtual std::uint64_t sent() const = 0;
  /// SHA-256 of the first content_length() bytes.
  virtual Digest content_digest() const = 0;
  virtual std::uint64_t content_length() const = 0;
};

/// A run's text from a line: in sequence, once, until the sender ends. Executed text is kept within
/// the size of the cache, so that loops work; a jump back further than that fails, as does the text
/// after a line that broke. Pure; one thread.
class LineFeed final : public ProgramFeed {
 public:
  static constexpr std::size_t kKeptBytes = 8 * 1024 * 1024;
  /// Bytes given to the interpreter at a time, so that free memory of the control is known early.
  static constexpr std::size_t kPiece = 1024;

  explicit LineFeed(std::size_t kept_bytes = kKeptBytes) : cache_(kept_bytes) {}

  /// More text. Not after `end` or `break_off`.
  void append(std::string_view text);
  /// The text is complete.
  void end() { has_ended_ = true; }
  /// The text broke off before its end: the part that arrived is still given.
  void break_off(std::string reason) { reason_ = std::move(reason); }

  /// Bytes the interpreter has taken, or waits beyond: all before may be replaced by new ones.
  std::uint64_t consumed() const { return consumed_; }

  interpreter::TextWindow fetch(interpreter::ProgramIndex program, std::uint64_t offset,
                                std::size_t min_bytes) override;
  interpreter::ProgramLookup find(std::string_view name) override;
  HeldText held_around(interpreter::ProgramIndex program, std::uint64_t offset,
                       std::size_t reach) const override {
    HeldText held = cache_.around(program, offset, reach);
    held.reaches_end = has_ended_ && held.end() == received_;
    return held;
  }
  std::uint64_t sent() const override { return received_; }
  Digest content_digest() const override { return hash_.digest(); }
  std::uint64_t content_length() const override { return received_; }

 private:
  std::string_view gather(std::uint64_t offset, std::size_t size);

  ChunkCache cache_;
  std::string stitched_;
  Sha256 hash_;
  std::uint64_t received_ = 0, consumed_ = 0;
  bool has_ended_ = false;
  std::string reason_;
};

}  // namespace dripline::feed
