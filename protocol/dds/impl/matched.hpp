#pragma once

#include <dds/dds.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/result.hpp"

/// Who is at the other end of our readers and writers. Participants are named by their GUID in
/// hexadecimal. Not to be called in listeners: these look into tables that listeners run under.
namespace dripline::dds {

Result<std::string> participant_key(dds_entity_t participant);

/// The participants whose readers `writer` serves, or whose writers `reader` hears.
std::set<std::string> matched_with_writer(dds_entity_t writer);
std::set<std::string> matched_with_reader(dds_entity_t reader);

struct Publication {
  std::string participant;
  std::vector<std::string> partitions;
};

/// The writer a sample came from; none when it is gone by now.
std::optional<Publication> publication(dds_entity_t reader, dds_instance_handle_t writer);

}  // namespace dripline::dds
