#pragma once

#include <concepts>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "clients/lib/server_types.hpp"

/// The part of api_members.hpp, which ends the macros, about the types of server_types.hpp.
namespace dripline::client {

/// The type itself, to be read or to be written.
template <class P, class T>
concept Is = std::same_as<std::remove_const_t<P>, T>;

/// The members whose keys are their own names.
#define DRIPLINE_MEMBER(name) v(#name, x.name);
#define DRIPLINE_MEMBERS(...) \
  NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(DRIPLINE_MEMBER, __VA_ARGS__)) static_assert(true)

template <class V>
void members(V& v, Is<ServerInfo::Dds> auto& x) {
  DRIPLINE_MEMBERS(domain, rejected);
}

template <class V>
void members(V& v, Is<ServerInfo::Health::Reason> auto& x) {
  DRIPLINE_MEMBERS(subject, status, message, detail);
}

template <class V>
void members(V& v, Is<ServerInfo::Health> auto& x) {
  DRIPLINE_MEMBERS(status, reasons);
}

template <class V>
void members(V& v, Is<ServerInfo::Mqtt::Sparkplug> auto& x) {
  DRIPLINE_MEMBERS(node, connected, since, fault, messages_published, rebirths);
}

template <class V>
void members(V& v, Is<ServerInfo::Mqtt> auto& x) {
  DRIPLINE_MEMBERS(broker, connected, since, fault, records_waiting, records_published,
                   states_published, records_missing);
  v.later("sparkplug", x.sparkplug);
}

template <class V>
void members(V& v, Is<ServerInfo::ProgramCache> auto& x) {
  DRIPLINE_MEMBERS(size_bytes, used_bytes, hits, misses, fetched, damaged, fault);
}

template <class V>
void members(V& v, Is<ServerInfo::Sharing> auto& x) {
  DRIPLINE_MEMBERS(term, standbys);
}

template <class V>
void members(V& v, Is<ServerInfo> auto& x) {
  DRIPLINE_MEMBERS(name, version, started, uptime_s, data_dir, machines, machines_connected,
                   programs, runs_active);
  v.later("health", x.health);
  v.later("mqtt", x.mqtt);
  v.later("program_cache", x.program_cache);
  v.later("sharing", x.sharing);
  DRIPLINE_MEMBERS(dds);
}

template <class V>
void members(V& v, Is<AuditState::Fault> auto& x) {
  DRIPLINE_MEMBERS(entry, what);
}

template <class V>
void members(V& v, Is<AuditState::Verification> auto& x) {
  DRIPLINE_MEMBERS(time, entries, intact, fault);
}

template <class V>
void members(V& v, Is<AuditState::Checkpoint> auto& x) {
  DRIPLINE_MEMBERS(number, entry, time, sha256, text);
}

template <class V>
void members(V& v, Is<AuditState::ArchiveFault> auto& x) {
  DRIPLINE_MEMBERS(file, what);
}

template <class V>
void members(V& v, Is<AuditState::Archives> auto& x) {
  DRIPLINE_MEMBERS(time, archives, intact, faults);
}

template <class V>
void members(V& v, Is<AuditState> auto& x) {
  DRIPLINE_MEMBERS(verification, checkpoint, public_key);
  v.later("archives", x.archives);
}

template <class V>
void members(V& v, Is<Backups::Backup> auto& x) {
  DRIPLINE_MEMBERS(id, made, made_by, size, added, verified);
}

template <class V>
void members(V& v, Is<Backups::Work> auto& x) {
  DRIPLINE_MEMBERS(kind, backup, phase, done, total);
}

template <class V>
void members(V& v, Is<Backups::Outcome> auto& x) {
  DRIPLINE_MEMBERS(kind, backup, time, error);
}

template <class V>
void members(V& v, Is<Backups> auto& x) {
  DRIPLINE_MEMBERS(folder, every_hours, overdue, backups, damaged, work, last);
}

}  // namespace dripline::client
