#include "protocol/dds/impl/domain.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "protocol/dds/impl/matched.hpp"
#include "protocol/dds/impl/security.hpp"

namespace dripline::dds {
namespace {

constexpr dds_domainid_t kMaxEndpointsPerProcess = 4096;

/// Cyclone knows the numbers in use in this process.
Result<Entity> create_domain(const std::string& configuration) {
  for (dds_domainid_t id = 0; id < kMaxEndpointsPerProcess; ++id) {
    const dds_entity_t created = dds_create_domain(id, configuration.c_str());
    if (created != DDS_RETCODE_PRECONDITION_NOT_MET) return own(created, "domain");
  }
  return fail(Errc::LimitExceeded, "DDS: {} endpoints in one process", kMaxEndpointsPerProcess);
}

/// Cyclone only reports "error"; people must learn that another server runs.
bool is_taken(std::uint16_t port) {
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return false;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  const bool failed = ::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0;
  ::close(fd);
  return failed;
}

}  // namespace

Result<Domain> open_domain(const NetworkOptions& options, Role role, std::uint32_t cell) {
  auto configuration = domain_configuration(options, role, cell);
  if (!configuration) return fail(configuration.error());
  Qos qos(dds_create_qos());
  if (options.security) {
    if (auto added = add_security(*options.security, qos.get()); !added) return fail(added.error());
  }
  if (role == Role::Server) {
    const std::uint16_t first = server_port(options.domain, cell);
    for (const int port : {first + 0, first + 1}) {
      if (!is_taken(static_cast<std::uint16_t>(port))) continue;
      return fail(Errc::Busy, "DDS domain {}: UDP port {} is in use (another server?)",
                  options.domain, port);
    }
  }
  auto domain = create_domain(*configuration);
  if (!domain) return fail(domain.error());
  // The domain is the only one of its number, so its participant is asked for by that number.
  dds_domainid_t id = 0;
  dds_get_domainid(domain->get(), &id);
  auto participant = own(dds_create_participant(id, qos.get(), nullptr), "participant");
  if (!participant) return fail(participant.error());
  auto key = participant_key(participant->get());
  if (!key) return fail(key.error());
  return Domain{std::move(*domain), std::move(*participant), std::move(*key)};
}

}  // namespace dripline::dds
