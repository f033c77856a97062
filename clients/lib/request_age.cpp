#include "clients/lib/request_age.hpp"

#include <algorithm>

namespace dripline::client {

void add_age(std::vector<std::pair<std::string, std::string>>& headers, RequestAge age) {
  constexpr const char* kName = "Dripline-Age";
  const auto known =
      std::ranges::find(headers, kName, [](const auto& field) { return field.first; });
  if (known == headers.end()) {
    headers.emplace_back(kName, std::to_string(age.count()));
  } else {
    known->second = std::to_string(std::stoll(known->second) + age.count());
  }
}

}  // namespace dripline::client
