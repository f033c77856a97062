#include "protocol/wire/impl/xmodem_block.hpp"

#include <algorithm>

namespace dripline::wire::xmodem {
namespace {

constexpr std::uint16_t kPolynomial = 0x1021;

constexpr auto kCrcTable = [] {
  std::array<std::uint16_t, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    auto crc = static_cast<std::uint16_t>(i << 8);
    for (int bit = 0; bit < 8; ++bit) {
      crc = static_cast<std::uint16_t>((crc << 1) ^ ((crc & 0x8000) != 0 ? kPolynomial : 0));
    }
    table[i] = crc;
  }
  return table;
}();

}  // namespace

std::uint16_t crc16(std::span<const std::byte> data) {
  std::uint16_t crc = 0;
  for (const std::byte byte : data) {
    const auto index = static_cast<std::uint8_t>((crc >> 8) ^ static_cast<std::uint8_t>(byte));
    crc = static_cast<std::uint16_t>((crc << 8) ^ kCrcTable[index]);
  }
  return crc;
}

std::uint8_t checksum(std::span<const std::byte> data) {
  unsigned sum = 0;
  for (const std::byte byte : data) sum += static_cast<unsigned>(byte);
  return static_cast<std::uint8_t>(sum);
}

std::vector<std::byte> make_block(std::uint8_t number, std::span<const std::byte> data,
                                  Check check) {
  std::vector<std::byte> block(kHeadSize + kBlockSize, kPadding);
  block[0] = static_cast<std::byte>(kSoh);
  block[1] = std::byte{number};
  block[2] = static_cast<std::byte>(~number);
  std::copy(data.begin(), data.end(), block.begin() + kHeadSize);
  const auto body = std::span(block).subspan(kHeadSize);
  if (check == Check::Sum) {
    block.push_back(std::byte{checksum(body)});
    return block;
  }
  const std::uint16_t crc = crc16(body);
  block.push_back(static_cast<std::byte>(crc >> 8));
  block.push_back(static_cast<std::byte>(crc & 0xff));
  return block;
}

void BlockReader::begin(char head, Check check) {
  size_ = head == kStx ? kLongBlockSize : kBlockSize;
  check_ = check;
  received_.clear();
  received_.reserve(2 + size_ + check_size(check));
  is_damaged_ = false;
}

bool BlockReader::take(std::byte character) {
  received_.push_back(character);
  return received_.size() == 2 + size_ + check_size(check_);
}

bool BlockReader::is_good() const {
  if (is_damaged_ || (received_[0] ^ received_[1]) != std::byte{0xff}) return false;
  const auto check = std::span(received_).subspan(2 + size_);
  if (check_ == Check::Sum) return std::byte{checksum(data())} == check[0];
  const std::uint16_t crc = crc16(data());
  return check[0] == static_cast<std::byte>(crc >> 8) &&
         check[1] == static_cast<std::byte>(crc & 0xff);
}

}  // namespace dripline::wire::xmodem
