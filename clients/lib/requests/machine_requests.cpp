// The calls of Client for machines: what is known of them, their panels, and what is keyed in.
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::path_of;
using impl::with_method;
using impl::with_page;
using impl::with_query;
namespace {

using Json = nlohmann::json;

}  // namespace

Reply<std::vector<Machine>> Client::machines() {
  constexpr std::size_t kPage = 1000;
  const std::string first = with_query(path_of("machines"), "limit", std::to_string(kPage));
  auto all = fetch_list<Machine>(first, "machines");
  for (std::size_t taken = kPage; all && all->size() == taken; taken += kPage) {
    auto page = fetch_list<Machine>(with_query(first, "after", all->back().name), "machines");
    if (!page) return page;
    std::ranges::move(*page, std::back_inserter(*all));
  }
  return all;
}

Reply<Machine> Client::machine(std::string_view name) {
  return fetch<Machine>(get(path_of("machines", name)));
}

Reply<std::vector<Memory>> Client::memories(std::string_view machine, std::string_view run,
                                            Page page) {
  const std::string path = with_query(path_of("machines", machine) + "/memory", "run", run);
  return fetch_list<Memory>(with_page(path, page), "memories");
}

Reply<PositionSet> Client::set_position(std::string_view machine, const PositionToSet& setting) {
  Json body{{"axis", setting.axis}, {"value", setting.value}};
  if (!setting.unit.empty()) body["unit"] = setting.unit;
  if (!setting.offset.empty()) body["offset"] = setting.offset;
  if (setting.tool) body["tool"] = *setting.tool;
  const char* const what = setting.tool ? "/touch-off" : "/datum";
  return fetch<PositionSet>(with_method("POST", path_of("machines", machine) + what), dumped(body));
}

Reply<JogDone> Client::jog(std::string_view machine, const JogToMake& step) {
  Json body{{"axis", step.axis}, {"distance", step.distance}};
  if (!step.unit.empty()) body["unit"] = step.unit;
  if (step.feed) body["feed"] = *step.feed;
  if (!step.hold.empty()) body["hold"] = step.hold;
  return fetch<JogDone>(with_method("POST", path_of("machines", machine) + "/jog"), dumped(body));
}

Reply<void> Client::keep_jog(std::string_view machine, std::string_view hold) {
  return perform(with_method("POST", path_of("machines", machine) + "/jog/hold"),
                 dumped({{"hold", hold}}));
}

Reply<PlaybackBlock> Client::play_back(std::string_view machine, std::string_view axes) {
  return fetch<PlaybackBlock>(
      get(with_query(path_of("machines", machine) + "/playback", "axes", axes)));
}

Reply<BegunRun> Client::key_in(std::string_view machine, std::string_view text) {
  return fetch<BegunRun>(with_method("POST", path_of("machines", machine) + "/mdi"),
                         dumped(Json{{"text", text}}));
}

Reply<void> Client::command_machine(std::string_view machine, const CommandRequest& request) {
  return send_command(path_of("machines", machine), request);
}

Reply<void> Client::confirm_gateway(std::string_view machine) {
  return perform(with_method("POST", path_of("machines", machine) + "/confirm-gateway"));
}

Reply<void> Client::remove_machine(std::string_view machine) {
  return perform(with_method("DELETE", path_of("machines", machine)));
}

}  // namespace dripline::client
