#include "gateway/interpreter/dialects/fanuc/errors.hpp"

#include <array>

#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr std::size_t kIdLength = 6;
constexpr auto user_alarm_ids() {
  std::array<char, kIdLength*(kHighestUserAlarm + 1)> ids{};
  for (int number = 0; number <= kHighestUserAlarm; ++number) {
    char* at = ids.data() + kIdLength * static_cast<std::size_t>(number);
    at[0] = 'P';
    at[1] = 'S';
    int rest = 3000 + number;
    for (std::size_t place = kIdLength - 1; place >= 2; --place, rest /= 10) {
      at[place] = static_cast<char>('0' + rest % 10);
    }
  }
  return ids;
}
constexpr auto kUserAlarmIds = user_alarm_ids();

}  // namespace

std::string_view user_alarm_id(int number) {
  invariant(number >= 0 && number <= kHighestUserAlarm, "#3000 was checked");
  return {kUserAlarmIds.data() + kIdLength * static_cast<std::size_t>(number), kIdLength};
}

}  // namespace dripline::interpreter::fanuc
