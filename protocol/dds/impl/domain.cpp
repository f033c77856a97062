#include "protocol/dds/impl/domain.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <filesystem>

#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/impl/entity.hpp"
#include "protocol/dds/impl/matched.hpp"

namespace dripline::dds {
namespace {

void add_plugin(dds_qos_t* qos, const std::string& service, const std::string& library,
                const std::string& function) {
  const std::string prefix = "dds.sec." + service + ".library.";
  dds_qset_prop(qos, (prefix + "path").c_str(), library.c_str());
  dds_qset_prop(qos, (prefix + "init").c_str(), ("init_" + function).c_str());
  dds_qset_prop(qos, (prefix + "finalize").c_str(), ("finalize_" + function).c_str());
}

Result<void> add_file(dds_qos_t* qos, const char* property, const std::string& file) {
  if (file.empty()) return fail(Errc::Syntax, "DDS security: {} names no file", property);
  std::error_code ec;
  if (!std::filesystem::is_regular_file(file, ec)) {
    return fail(Errc::NotFound, "DDS security: {}: no file {}", property, file);
  }
  dds_qset_prop(qos, property, ("file:" + file).c_str());
  return {};
}

/// Puts the DDS Security plugins and files on a participant's QoS. A missing file is an
/// error here; a wrong private key shows only because peers do not match.
/// Errors: NotFound, Syntax (a file not named).
Result<void> add_security(const SecurityFiles& files, dds_qos_t* qos) {
  add_plugin(qos, "auth", "dds_security_auth", "authentication");
  add_plugin(qos, "access", "dds_security_ac", "access_control");
  add_plugin(qos, "crypto", "dds_security_crypto", "crypto");
  const std::pair<const char*, const std::string*> properties[] = {
      {"dds.sec.auth.identity_ca", &files.identity_ca},
      {"dds.sec.auth.identity_certificate", &files.certificate},
      {"dds.sec.auth.private_key", &files.private_key},
      {"dds.sec.access.permissions_ca", &files.permissions_ca},
      {"dds.sec.access.governance", &files.governance},
      {"dds.sec.access.permissions", &files.permissions},
  };
  for (const auto& [property, file] : properties) {
    if (auto added = add_file(qos, property, *file); !added) return added;
  }
  if (!files.revocation_list) return {};
  return add_file(qos, "org.eclipse.cyclonedds.sec.auth.crl", *files.revocation_list);
}

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

Result<void> check_port(const NetworkOptions& options, int port) {
  if (!is_taken(static_cast<std::uint16_t>(port))) return {};
  return fail(Errc::Busy, "DDS domain {}: UDP port {} is in use (another server?)", options.domain,
              port);
}

Result<void> check_ports_of(const NetworkOptions& options, std::uint32_t cell) {
  if (auto free = check_port(options, first_port(options, cell)); !free) return free;
  return check_port(options, first_port(options, cell) + 1);
}

}  // namespace

Result<void> check_ports(const NetworkOptions& options) {
  for (std::uint32_t cell = 0; cell < options.cells; ++cell) {
    if (auto free = check_ports_of(options, cell); !free) return free;
  }
  return {};
}

Result<void> check_second_ports(const NetworkOptions& options) {
  for (std::uint32_t cell = 0; cell < options.cells; ++cell) {
    if (auto free = check_port(options, first_port(options, cell) + 1); !free) return free;
  }
  return {};
}

Result<Domain> open_domain(const NetworkOptions& options, Role role, std::uint32_t cell) {
  auto configuration = domain_configuration(options, role, cell);
  if (!configuration) return fail(configuration.error());
  Qos qos(dds_create_qos());
  if (options.security) {
    if (auto added = add_security(*options.security, qos.get()); !added) return fail(added.error());
  }
  if (role == Role::Server) {
    if (auto free = check_ports_of(options, cell); !free) return fail(free.error());
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
