#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/result.hpp"

/// The participants at the other end of our readers and writers, named by their GUID in
/// hexadecimal. Not to be called in listeners: these functions access tables that are locked there.
namespace dripline::dds {

Result<std::string> participant_key(dds_entity_t participant);

/// The participants whose readers match `writer`, or whose writers match `reader`.
std::set<std::string> matched_with_writer(dds_entity_t writer);
std::set<std::string> matched_with_reader(dds_entity_t reader);

/// Of the participants whose writers match `reader`: the highest term that one of them states; 0:
/// none does.
std::map<std::string, std::uint64_t> terms_of_writers(dds_entity_t reader);

struct Publication {
  std::string participant;
  std::vector<std::string> partitions;
};

/// The writer of a sample; empty when it is gone.
std::optional<Publication> publication(dds_entity_t reader, dds_instance_handle_t writer);

}  // namespace dripline::dds
