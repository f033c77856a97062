#pragma once

#include "clients/lib/api_types.hpp"
#include "clients/lib/impl/server_members.hpp"

/// The part of api_members.hpp, which ends the macros, about the release of programs.
namespace dripline::client {

template <class V>
void members(V& v, Is<Pin> auto& x) {
  DRIPLINE_MEMBERS(program, revision, sha256);
}

template <class V>
void members(V& v, Is<Decision> auto& x) {
  DRIPLINE_MEMBERS(id, step, state, time, who, comment);
  v.later("closure", x.closure);
  DRIPLINE_MEMBERS(text, signature);
}

template <class V>
void members(V& v, Is<Closure::Site> auto& x) {
  DRIPLINE_MEMBERS(program, revision, line);
}

template <class V>
void members(V& v, Is<Closure::Call> auto& x) {
  DRIPLINE_MEMBERS(name, program, revision, sha256, state, site);
}

template <class V>
void members(V& v, Is<Closure::Missing> auto& x) {
  DRIPLINE_MEMBERS(name, site);
}

template <class V>
void members(V& v, Is<Closure> auto& x) {
  DRIPLINE_MEMBERS(program, revision, calls, missing, computed);
}

template <class V>
void members(V& v, Is<RevisionStates> auto& x) {
  DRIPLINE_MEMBERS(state, steps, public_key);
}

}  // namespace dripline::client
