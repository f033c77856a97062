#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// XMODEM's characters and blocks: SOH, number, its complement, 128 characters, checksum or CRC.
/// STX begins a block of 1024, which is received and never sent.
namespace dripline::wire::xmodem {

inline constexpr char kSoh = 0x01, kStx = 0x02, kEot = 0x04, kAck = 0x06, kNak = 0x15, kCan = 0x18,
                      kCrcWanted = 'C';
inline constexpr std::byte kPadding{0x1a};
inline constexpr std::size_t kBlockSize = 128, kLongBlockSize = 1024;
inline constexpr std::size_t kHeadSize = 3;  ///< SOH, number, complement

enum class Check : std::uint8_t { Sum, Crc };
constexpr std::size_t check_size(Check check) {
  return check == Check::Crc ? 2 : 1;
}

/// Polynomial 0x1021, start 0, as XMODEM-CRC uses it.
std::uint16_t crc16(std::span<const std::byte> data);
std::uint8_t checksum(std::span<const std::byte> data);

/// `data` is at most 128 characters; the rest is padding.
std::vector<std::byte> make_block(std::uint8_t number, std::span<const std::byte> data,
                                  Check check);

/// A block that is received character by character.
class BlockReader {
 public:
  /// `head` is SOH or STX.
  void begin(char head, Check check);
  /// true: the block has all its characters.
  bool take(std::byte character);
  void damage() { is_damaged_ = true; }  ///< one of its characters had a line fault
  /// Of a complete block.
  bool is_good() const;
  std::uint8_t number() const { return static_cast<std::uint8_t>(received_[0]); }
  std::span<const std::byte> data() const { return std::span(received_).subspan(2, size_); }

 private:
  std::size_t size_ = kBlockSize;
  Check check_ = Check::Crc;
  std::vector<std::byte> received_;  ///< number, complement, data, check
  bool is_damaged_ = false;
};

}  // namespace dripline::wire::xmodem
