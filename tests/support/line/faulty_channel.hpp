#pragma once

#include <atomic>
#include <memory>
#include <random>

#include "protocol/serial/channel.hpp"

namespace dripline::test_support {

/// How often what goes wrong, of each character; 0 to 1.
struct FaultRates {
  double drop = 0, twice = 0, flip = 0;
  double parity = 0;  ///< the UART says so; the character is lost
  double line_break = 0;
};

/// What a test does to a channel from outside; any thread.
struct ChannelControl {
  std::atomic<bool> is_unplugged = false;
  std::atomic<bool> is_stuck = false;  ///< the driver takes nothing
  std::atomic<bool> cts = true;
  std::atomic<bool> rts = true;  ///< as set by the other side of the channel
};

/// A channel whose received characters suffer, by a seeded chance, and which can be unplugged. The
/// modem lines are the test's.
class FaultyChannel final : public serial::Channel {
 public:
  FaultyChannel(std::unique_ptr<serial::Channel> inner, FaultRates rates, unsigned seed,
                std::shared_ptr<ChannelControl> control)
      : inner_(std::move(inner)), rates_(rates), random_(seed), control_(std::move(control)) {}

  Result<serial::Received> read(std::span<std::byte> room) override;
  Result<std::size_t> write(std::span<const std::byte> bytes) override;
  std::optional<std::size_t> unsent() const override { return inner_->unsent(); }
  Result<std::optional<wire::InputLines>> input_lines() override;
  Result<void> set_output_lines(wire::OutputLines lines) override;
  Result<void> apply(const wire::LineSettings& settings) override {
    return inner_->apply(settings);
  }
  int descriptor() const override { return inner_->descriptor(); }
  std::string name() const override { return inner_->name(); }

 private:
  bool happens(double rate) { return std::uniform_real_distribution<>(0, 1)(random_) < rate; }

  std::unique_ptr<serial::Channel> inner_;
  FaultRates rates_;
  std::mt19937 random_;
  std::shared_ptr<ChannelControl> control_;
  std::vector<std::byte> waiting_;
};

}  // namespace dripline::test_support
