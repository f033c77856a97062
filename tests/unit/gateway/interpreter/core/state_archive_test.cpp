#include "gateway/interpreter/core/language/state_archive.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace dripline::interpreter::language {
namespace {

struct Inner {
  Plane plane = Plane::XY;
  std::optional<double> radius;
  bool operator==(const Inner&) const = default;
};
struct Outer {
  int number = 0;
  std::array<Inner, 2> inner{};
  std::vector<Inner> list;
  std::string name;
  std::variant<bool, Inner> choice;
  Length length;
  bool operator==(const Outer&) const = default;
};

Outer example() {
  return {7, {Inner{Plane::ZX, 1.5}, Inner{}}, {{Plane::YZ, {}}}, "O12", Inner{}, Length::mm(3)};
}

std::vector<std::byte> bytes_of(Outer value) {
  StateWriter writer;
  writer(value);
  return writer.take();
}

TEST(StateArchive, StoresEveryMemberOfAPlainStruct) {
  const auto bytes = bytes_of(example());
  StateReader reader(bytes);
  Outer read;
  reader(read);
  EXPECT_TRUE(reader.is_complete());
  EXPECT_EQ(read, example());
}

TEST(StateArchive, TakesCutBytesForDamage) {
  const auto whole = bytes_of(example());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::vector<std::byte> cut(whole.begin(),
                                     whole.begin() + static_cast<std::ptrdiff_t>(size));
    StateReader reader(cut);
    Outer read;
    reader(read);
    EXPECT_FALSE(reader.is_complete()) << size;
  }
}

TEST(StateArchive, TakesAnEnumeratorThatDoesNotExistForDamage) {
  auto plane = static_cast<Plane>(3);
  StateWriter writer;
  writer(plane);
  const auto bytes = writer.take();
  StateReader reader(bytes);
  Plane read = Plane::ZX;
  reader(read);
  EXPECT_TRUE(reader.is_damaged());
  EXPECT_EQ(read, Plane::ZX);
}

TEST(StateArchive, RefusesNumbersThatGeometryCannotWorkWith) {
  double number = std::numeric_limits<double>::infinity();
  StateWriter writer;
  writer(number);
  const auto bytes = writer.take();
  double read = 0;
  StateReader any(bytes), finite(bytes, Numbers::Finite);
  any(read);
  finite(read);
  EXPECT_FALSE(any.is_damaged());
  EXPECT_TRUE(finite.is_damaged());
}

}  // namespace
}  // namespace dripline::interpreter::language
