#pragma once

#include <cstdint>
#include <optional>

#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::feed {

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

  /// The *sent* counter: bytes of the main program received without a gap from its beginning.
  virtual std::uint64_t sent() const = 0;
  /// SHA-256 of the first content_length() bytes.
  virtual Digest content_digest() const = 0;
  virtual std::uint64_t content_length() const = 0;
};

}  // namespace dripline::feed
