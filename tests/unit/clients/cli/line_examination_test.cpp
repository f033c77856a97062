#include "clients/cli/port/line_examination.hpp"

#include <gtest/gtest.h>
#include <bit>
#include <deque>

#include "protocol/wire/character_coder.hpp"

namespace dripline::cli {
namespace {

using std::chrono::milliseconds;
using wire::LineTime;

/// A control that punches one program after the other, in virtual time. At another rate than its
/// own it is heard as noise.
class PunchingControl final : public serial::Channel {
 public:
  explicit PunchingControl(const std::string& settings) {
    EXPECT_TRUE(wire::apply_short_form(settings, own_));
    std::string program;
    for (int i = 1; i < 500; ++i) program += fmt::format("N{} G1 X{}.25 Y-{}\n", i, i % 97, i % 41);
    wire::CharacterEncoder encoder(wire::CharacterCode::Ascii, wire::EndOfBlock::LfCr);
    EXPECT_TRUE(encoder.encode(program, text_));
  }

  LineTime now{};
  bool is_silent = false, listens_to_xoff = true, is_joined = false;
  std::size_t still_sends = 7;  ///< after XOFF
  LineTime ends_at = std::chrono::hours(1);

  void pass(milliseconds time) {
    const LineTime end = now + time;
    const auto character = wire::character_time(own_);
    while (next_ <= end) {
      next_ += character;
      if (is_silent || next_ > ends_at || (left_ && *left_ == 0)) continue;
      if (left_) --*left_;
      put(static_cast<std::uint8_t>(text_[at_++ % text_.size()]));
    }
    now = end;
  }

  Result<serial::Received> read(std::span<std::byte> room) override {
    serial::Received got;
    while (got.bytes < room.size() && !heard_.empty()) {
      const Heard heard = heard_.front();
      heard_.pop_front();
      if (heard.fault) {
        got.fault = heard.fault;
        break;
      }
      room[got.bytes++] = heard.byte;
    }
    return got;
  }
  Result<std::size_t> write(std::span<const std::byte> bytes) override {
    for (const auto byte : bytes) {
      if (is_joined) heard_.push_back({byte, std::nullopt});
      if (byte == std::byte{0x13} && listens_to_xoff) left_ = still_sends;
      if (byte == std::byte{0x11}) left_.reset();
    }
    return bytes.size();
  }
  std::optional<std::size_t> unsent() const override { return 0; }
  Result<std::optional<wire::InputLines>> input_lines() override {
    return std::optional(wire::InputLines{out_.rts, true, true});
  }
  Result<void> set_output_lines(wire::OutputLines lines) override {
    out_ = lines;
    return {};
  }
  Result<void> apply(const wire::LineSettings& settings) override {
    ours_ = settings;
    return {};
  }
  int descriptor() const override { return -1; }
  std::string name() const override { return "control"; }

 private:
  struct Heard {
    std::byte byte{};
    std::optional<wire::LineFault> fault;
  };

  /// `c` has seven bits; even parity is bit 8 of a line that reads eight.
  void put(std::uint8_t c) {
    const bool is_odd = std::popcount(c) % 2 != 0;
    if (ours_.baud != own_.baud) {
      if (++noise_ % 2 == 0) return heard_.push_back({{}, wire::LineFault::Framing});
      return heard_.push_back({static_cast<std::byte>(0xE0 + noise_ % 24), std::nullopt});
    }
    const bool has_ninth_bit = own_.data_bits == 8 && own_.parity == wire::Parity::Even;
    if (has_ninth_bit && ours_.parity == wire::Parity::None) {
      if (!is_odd) return heard_.push_back({{}, wire::LineFault::Framing});
    } else if (has_ninth_bit && ours_.parity == wire::Parity::Odd) {
      return heard_.push_back({{}, wire::LineFault::Parity});
    }
    const bool shows_parity = own_.data_bits == 7 && ours_.data_bits == 8 && is_odd;
    heard_.push_back({static_cast<std::byte>(shows_parity ? c | 0x80 : c), std::nullopt});
  }

  wire::LineSettings own_, ours_;
  wire::OutputLines out_;
  std::vector<std::byte> text_;
  std::size_t at_ = 0;
  unsigned noise_ = 0;
  LineTime next_{};
  std::optional<std::size_t> left_;
  std::deque<Heard> heard_;
};

wire::LineObservation examine(PunchingControl& control) {
  LineExamination parts{control,
                        milliseconds(60'000),
                        true,
                        [&](milliseconds time) { control.pass(time); },
                        [&] { return control.now; },
                        [] { return false; },
                        [](std::string_view) {}};
  auto seen = examine_line(parts);
  EXPECT_TRUE(seen);
  return seen ? *seen : wire::LineObservation{};
}

struct Line {
  const char* name;
  const char* settings;
  const char* found;
};

class ExamineLine : public testing::TestWithParam<Line> {};

TEST_P(ExamineLine, FindsTheSettingsOfAControlThatPunches) {
  PunchingControl control(GetParam().settings);
  const auto diagnosis = wire::diagnose(examine(control));
  ASSERT_TRUE(diagnosis.settings);
  EXPECT_EQ(wire::short_form(*diagnosis.settings), GetParam().found);
  EXPECT_EQ(diagnosis.settings->end_of_block, wire::EndOfBlock::LfCr);
  EXPECT_GT(diagnosis.confidence, wire::kGoodScore);
}

INSTANTIATE_TEST_SUITE_P(, ExamineLine,
                         testing::Values(Line{"plain", "9600n81", "9600n81"},
                                         Line{"tnc", "2400e71", "2400e71"},
                                         Line{"slow", "110e71", "110e71"},
                                         Line{"quick", "115200n81", "115200n81"},
                                         Line{"ninth_bit", "4800e81", "4800e81"}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(ExamineLine_, CountsWhatLeavesAfterXoff) {
  PunchingControl control("9600e71");
  const auto seen = examine(control);
  EXPECT_EQ(seen.after_stop, 7U);
  EXPECT_FALSE(seen.never_stopped);
  control.listens_to_xoff = false;
  EXPECT_TRUE(examine(control).never_stopped);
}

TEST(ExamineLine_, DoesNotTakeTheEndOfAProgramForAStop) {
  PunchingControl control("9600e71");
  control.ends_at = milliseconds(2500);
  EXPECT_FALSE(examine(control).after_stop);
}

TEST(ExamineLine_, LooksAtTheWiring) {
  PunchingControl control("9600n81");
  const auto seen = examine(control);
  ASSERT_TRUE(seen.wiring);
  EXPECT_TRUE(seen.wiring->all_on.cts);
  EXPECT_FALSE(seen.wiring->rts_off.cts);
  EXPECT_TRUE(seen.wiring->dtr_off.dsr);
}

TEST(ExamineLine_, HearsItselfWhenThePinsAreJoined) {
  PunchingControl control("9600n81");
  control.is_silent = control.is_joined = true;
  EXPECT_TRUE(examine(control).is_echoed);
  control.is_joined = false;
  EXPECT_FALSE(examine(control).is_echoed);
}

}  // namespace
}  // namespace dripline::cli
