#include "protocol/dds/impl/matched.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "protocol/dds/qos.hpp"

namespace dripline::dds {
namespace {

struct EndpointDeleter {
  void operator()(dds_builtintopic_endpoint_t* endpoint) const {
    dds_builtintopic_free_endpoint(endpoint);
  }
};
using Endpoint = std::unique_ptr<dds_builtintopic_endpoint_t, EndpointDeleter>;

std::string hex(const dds_guid_t& guid) {
  return fmt::format("{:02x}", fmt::join(guid.v, ""));
}

/// `take(endpoint)` of each matched one.
template <class List, class Data, class Take>
void each_matched(dds_entity_t entity, List list, Data data, Take take) {
  std::vector<dds_instance_handle_t> handles(16);
  dds_return_t count = list(entity, handles.data(), handles.size());
  while (count > static_cast<dds_return_t>(handles.size())) {
    handles.resize(static_cast<std::size_t>(count));
    count = list(entity, handles.data(), handles.size());
  }
  for (dds_return_t i = 0; i < count; ++i) {
    const Endpoint endpoint(data(entity, handles[static_cast<std::size_t>(i)]));
    if (endpoint) take(*endpoint);
  }
}

template <class List, class Data>
std::set<std::string> participants(dds_entity_t entity, List list, Data data) {
  std::set<std::string> result;
  each_matched(entity, list, data, [&](const dds_builtintopic_endpoint_t& endpoint) {
    result.insert(hex(endpoint.participant_key));
  });
  return result;
}

std::vector<std::string> partitions_of(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** names = nullptr;
  if (qos == nullptr || !dds_qget_partition(qos, &count, &names)) return {};
  std::vector<std::string> result;
  for (std::uint32_t i = 0; i < count; ++i) {
    result.emplace_back(names[i]);
    dds_free(names[i]);
  }
  dds_free(names);
  return result;
}

}  // namespace

Result<std::string> participant_key(dds_entity_t participant) {
  dds_guid_t guid{};
  if (const auto rc = dds_get_guid(participant, &guid); rc != DDS_RETCODE_OK) {
    return fail(Errc::Io, "DDS: participant without GUID: {}", dds_strretcode(rc));
  }
  return hex(guid);
}

std::set<std::string> matched_with_writer(dds_entity_t writer) {
  return participants(writer, dds_get_matched_subscriptions, dds_get_matched_subscription_data);
}

std::set<std::string> matched_with_reader(dds_entity_t reader) {
  return participants(reader, dds_get_matched_publications, dds_get_matched_publication_data);
}

std::map<std::string, std::uint64_t> terms_of_writers(dds_entity_t reader) {
  std::map<std::string, std::uint64_t> result;
  each_matched(reader, dds_get_matched_publications, dds_get_matched_publication_data,
               [&](const dds_builtintopic_endpoint_t& endpoint) {
                 auto& term = result[hex(endpoint.participant_key)];
                 term = std::max(term, term_in(endpoint.qos));
               });
  return result;
}

std::optional<Publication> publication(dds_entity_t reader, dds_instance_handle_t writer) {
  const Endpoint endpoint(dds_get_matched_publication_data(reader, writer));
  if (!endpoint) return std::nullopt;
  return Publication{hex(endpoint->participant_key), partitions_of(endpoint->qos)};
}

}  // namespace dripline::dds
