#include "clients/tools/authority/ledger.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dripline::authority {
namespace {

using Json = nlohmann::json;

std::int64_t seconds_of(UtcTime time) {
  return std::chrono::floor<std::chrono::seconds>(time).time_since_epoch().count();
}

/// Throws where a member is missing or of another type.
Issued read_issued(const Json& json) {
  const auto time = [](const Json& seconds) {
    return UtcTime(std::chrono::seconds(seconds.get<std::int64_t>()));
  };
  Issued issued;
  const bool is_server = json.at("role").get<std::string>() == to_string(Role::Server);
  issued.holder = {is_server ? Role::Server : Role::Gateway, json.at("name").get<std::string>()};
  issued.serial = json.at("serial").get<std::string>();
  issued.validity = {time(json.at("not_before")), time(json.at("not_after"))};
  if (json.contains("revoked")) issued.revoked = time(json.at("revoked"));
  return issued;
}

}  // namespace

const Issued* Ledger::newest(const Holder& holder) const {
  const auto found = std::find_if(issued.rbegin(), issued.rend(),
                                  [&](const Issued& each) { return each.holder == holder; });
  return found == issued.rend() ? nullptr : &*found;
}

bool Ledger::revoke(const Holder& holder, UtcTime now) {
  bool is_changed = false;
  for (auto& each : issued) {
    if (each.holder != holder || each.revoked) continue;
    each.revoked = std::chrono::floor<std::chrono::seconds>(now);
    is_changed = true;
  }
  return is_changed;
}

std::string write_ledger(const Ledger& ledger) {
  auto list = Json::array();
  for (const auto& each : ledger.issued) {
    Json json{{"role", to_string(each.holder.role)},
              {"name", each.holder.name},
              {"serial", each.serial},
              {"not_before", seconds_of(each.validity.not_before)},
              {"not_after", seconds_of(each.validity.not_after)}};
    if (each.revoked) json["revoked"] = seconds_of(*each.revoked);
    list.push_back(std::move(json));
  }
  return Json{{"shop", ledger.shop}, {"issued", std::move(list)}}.dump(1) + "\n";
}

Result<Ledger> parse_ledger(std::string_view text) {
  try {
    const auto json = Json::parse(text);
    Ledger ledger;
    ledger.shop = json.at("shop").get<std::string>();
    for (const auto& each : json.at("issued")) ledger.issued.push_back(read_issued(each));
    return ledger;
  } catch (const Json::exception& wrong) {
    return fail(Errc::Corrupt, "the list of issued certificates is damaged: {}", wrong.what());
  }
}

}  // namespace dripline::authority
