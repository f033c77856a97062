#include "protocol/dds/configuration.hpp"

#include <algorithm>
#include <charconv>
#include <span>

#include <dds/dds.h>
#include <dds/ddsrt/log.h>

#include "protocol/base/digest.hpp"
#include "protocol/base/markup.hpp"

namespace dripline::dds {

namespace {

constexpr std::uint32_t kMaxDomain = 230;  // above this, the ports exceed 16 bits
constexpr std::uint16_t kLowestPort = 1024;
constexpr std::size_t kMaxServers = 8;

bool is_plain(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
}

Result<void> check_options(const NetworkOptions& options) {
  if (options.domain > kMaxDomain) {
    return fail(Errc::LimitExceeded, "DDS domain {}, at most {}", options.domain, kMaxDomain);
  }
  if (options.interface.empty() || !is_plain(options.interface)) {
    return fail(Errc::Syntax, "DDS interface '{}' is not a name or address", options.interface);
  }
  if (options.server.empty() || !is_plain(options.server)) {
    return fail(Errc::Syntax, "DDS server '{}' is not host or host:port", options.server);
  }
  if (options.port != 0 && options.port < kLowestPort) {
    return fail(Errc::LimitExceeded, "DDS port {}, at least {}", options.port, kLowestPort);
  }
  if (options.port > 65535 - 2 * options.cells) {
    return fail(Errc::LimitExceeded, "DDS port {}: the {} cells need two ports each, up to 65535",
                options.port, options.cells);
  }
  if (!is_plain(options.tag) || options.tag.size() > 128) {
    return fail(Errc::Syntax, "DDS tag '{}' is not a plain word", options.tag);
  }
  if (options.discovery_interval_ms < 10 || options.discovery_interval_ms > 60'000) {
    return fail(Errc::LimitExceeded, "discovery interval {} ms, 10 to 60000",
                options.discovery_interval_ms);
  }
  if (options.lease_ms < 2 * options.discovery_interval_ms || options.lease_ms > 600'000) {
    return fail(Errc::LimitExceeded,
                "lease {} ms, from twice the discovery interval ({} ms) to 600000",
                options.lease_ms, options.discovery_interval_ms);
  }
  const std::uint32_t cells = options.cells;
  if (cells < kFewestCells || cells > kMostCells || (cells & (cells - 1)) != 0) {
    return fail(Errc::LimitExceeded, "{} DDS cells: 8, 16, 32 or 64 are possible", cells);
  }
  return {};
}

bool is_loopback(const std::string& interface) {
  return interface == "lo" || interface.starts_with("127.");
}

std::string interface_element(const std::string& interface) {
  const bool is_address = interface.find_first_not_of("0123456789.") == std::string::npos ||
                          interface.find(':') != std::string::npos;
  return fmt::format(R"(<NetworkInterface {}="{}" multicast="false"/>)",
                     is_address ? "address" : "name", escape_markup(interface));
}

/// A block of 32 KiB travels in one datagram on loopback, where no wire limits it; elsewhere
/// Cyclone's own sizes keep IP from fragmenting.
std::string size_elements(const std::string& interface) {
  if (!is_loopback(interface)) return {};
  return "<MaxMessageSize>65500B</MaxMessageSize><MaxRexmitMessageSize>65500B</"
         "MaxRexmitMessageSize>"
         "<FragmentSize>65000B</FragmentSize>";
}

/// A port in the server's address is that of its first cell.
Result<std::string> server_place(const NetworkOptions& options, std::string_view server,
                                 std::uint32_t cell) {
  const auto colon = server.find(':');
  if (colon == std::string_view::npos) {
    return fmt::format("{}:{}", server, server_port(options.domain, cell));
  }
  const char* const end = server.data() + server.size();
  std::uint16_t port = 0;
  const auto read = std::from_chars(server.data() + colon + 1, end, port);
  if (read.ec != std::errc{} || read.ptr != end || port == 0 || port > 65535 - 2 * options.cells) {
    return fail(Errc::Syntax, "DDS server '{}' is not host or host:port", server);
  }
  return fmt::format("{}:{}", server.substr(0, colon), port + 2 * cell);
}

/// The gateway's peers: its server, and those that may take over from it.
Result<std::string> peer_elements(const NetworkOptions& options, std::uint32_t cell) {
  std::string peers;
  std::size_t count = 0;
  std::string_view rest = options.server;
  for (;;) {
    const auto comma = rest.find(',');
    const std::string_view server = rest.substr(0, comma);
    if (server.empty()) {
      return fail(Errc::Syntax, "DDS server '{}': a name is missing beside a comma",
                  options.server);
    }
    if (++count > kMaxServers) {
      return fail(Errc::LimitExceeded, "DDS server '{}': at most {} servers", options.server,
                  kMaxServers);
    }
    const auto place = server_place(options, server, cell);
    if (!place) return fail(place.error());
    peers += fmt::format("<Peer Address=\"{}\"/>", escape_markup(*place));
    if (comma == std::string_view::npos) return peers;
    rest.remove_prefix(comma + 1);
  }
}

/// Without multicast Cyclone announces a participant at its own address too, at the ports of as
/// many indexes as MaxAutoParticipantIndex allows: with the usual base and ten of them, all cells
/// and all gateways of the server's computer would meet each other, and learn of all machines. So
/// each cell has a base of its own, at which it is the only index.
Result<std::string> place_elements(const NetworkOptions& options, Role role, std::uint32_t cell) {
  constexpr std::uint32_t kMetaOffset = 10;  // Cyclone's, of the first unicast port
  if (role == Role::Server && options.port != 0) {
    return fmt::format(
        "<ParticipantIndex>0</ParticipantIndex><MaxAutoParticipantIndex>0</"
        "MaxAutoParticipantIndex><Ports><Base>{}</Base><DomainGain>0</DomainGain></Ports>",
        options.port + 2 * cell - kMetaOffset);
  }
  const std::string ports = fmt::format(
      "<MaxAutoParticipantIndex>0</MaxAutoParticipantIndex><Ports><Base>{}</Base></Ports>",
      server_port(0, cell) - kMetaOffset);
  if (role == Role::Server) return "<ParticipantIndex>0</ParticipantIndex>" + ports;
  const auto peers = peer_elements(options, cell);
  if (!peers) return fail(peers.error());
  return fmt::format("<ParticipantIndex>none</ParticipantIndex>{}<Peers>{}</Peers>", ports, *peers);
}

}  // namespace

Result<void> check_exposure(const NetworkOptions& options) {
  if (is_loopback(options.interface) || options.security || options.is_open_network_allowed)
    return {};
  return fail(
      Errc::Denied,
      "DDS on interface '{}' has no authentication: any host on that network can read programs "
      "and command the machines. Stay on lo, name a folder of dnc pki with dds-security, or take a "
      "network that only server and gateways are on and confirm it with dds-open-network = yes",
      options.interface);
}

std::uint32_t cell_of(const std::string& machine, std::uint32_t cells) {
  return crc32(std::as_bytes(std::span(machine))) % cells;
}

bool takes_machine(const std::string& machine, std::uint32_t cell, std::uint32_t cells) {
  for (std::uint32_t known = kFewestCells; known <= cells; known *= 2) {
    if (cell_of(machine, known) == cell) return true;
  }
  return false;
}

Result<std::string> domain_configuration(const NetworkOptions& options, Role role,
                                         std::uint32_t cell) {
  if (auto checked = check_options(options); !checked) return fail(checked.error());
  const auto place = place_elements(options, role, cell);
  if (!place) return fail(place.error());
  // ExternalDomainId is the number on the network; the one in this process may differ, so that
  // several ends fit into one process. The watermarks only have to be above what the writers'
  // history can hold (qos.cpp), since a writer must never wait for an acknowledgment. A closing
  // endpoint waits for acknowledgments only as long as a live peer needs (Cyclone: 1 s).
  return fmt::format(
      R"(<CycloneDDS><Domain Id="any"><General><Interfaces>{}</Interfaces>)"
      "<AllowMulticast>false</AllowMulticast>{}</General>"
      "<Discovery><ExternalDomainId>{}</ExternalDomainId><Tag>{}</Tag>{}"
      "<SPDPInterval>{}ms</SPDPInterval><LeaseDuration>{}ms</LeaseDuration></Discovery>"
      "<Internal><Watermarks><WhcAdaptive>false</WhcAdaptive><WhcHigh>16MB</WhcHigh>"
      "<WhcHighInit>16MB</WhcHighInit></Watermarks>"
      "<WriterLingerDuration>100ms</WriterLingerDuration></Internal></Domain></CycloneDDS>",
      interface_element(options.interface), size_elements(options.interface), options.domain,
      escape_markup(options.tag), *place, options.discovery_interval_ms, options.lease_ms);
}

namespace {

using Receiver = void (*)(bool is_error, std::string_view text);

void pass_on(void* userdata, const dds_log_data_t* entry) {
  std::string_view text(entry->message, entry->size);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.remove_suffix(1);
  constexpr std::uint32_t kErrors = DDS_LC_FATAL | DDS_LC_ERROR;
  reinterpret_cast<Receiver>(userdata)((entry->priority & kErrors) != 0, text);
}

}  // namespace

void send_log_to(Receiver to) {
  dds_set_log_sink(pass_on, reinterpret_cast<void*>(to));
  dds_set_trace_sink(pass_on, reinterpret_cast<void*>(to));
}

}  // namespace dripline::dds
