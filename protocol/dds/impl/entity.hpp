#pragma once

#include <dds/dds.h>

#include <memory>
#include <utility>

#include "protocol/base/result.hpp"

/// Ownership of Cyclone DDS objects. Deleting an entity deletes its children and waits for their
/// listeners, so a callback's target must outlive its entity and never delete it.
namespace dripline::dds {

class Entity {
 public:
  Entity() = default;
  explicit Entity(dds_entity_t handle) : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Entity() {
    if (handle_ > 0) dds_delete(handle_);
  }
  dds_entity_t get() const { return handle_; }

 private:
  dds_entity_t handle_ = 0;
};

/// The return value of a dds_create_... call as a Result.
inline Result<Entity> own(dds_entity_t created, std::string_view what) {
  if (created > 0) return Entity(created);
  return fail(Errc::Io, "DDS: {}: {}", what, dds_strretcode(created));
}

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

struct ListenerDeleter {
  void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};
using Listener = std::unique_ptr<dds_listener_t, ListenerDeleter>;

/// At most `capacity` samples on loan from a reader, returned at the end of the scope. A reader
/// keeps room for as many as were ever asked for, and clears all of it with each return.
template <std::size_t capacity>
class Loan {
 public:
  explicit Loan(dds_entity_t reader)
      : reader_(reader), size_(dds_take(reader, samples_, infos_, capacity, capacity)) {}
  Loan(const Loan&) = delete;
  Loan& operator=(const Loan&) = delete;
  ~Loan() {
    if (size_ > 0) dds_return_loan(reader_, samples_, size_);
  }
  std::size_t size() const { return size_ > 0 ? static_cast<std::size_t>(size_) : 0; }
  const void* sample(std::size_t i) const { return samples_[i]; }
  const dds_sample_info_t& info(std::size_t i) const { return infos_[i]; }

 private:
  dds_entity_t reader_;
  void* samples_[capacity] = {};  // a null first element requests a loan
  dds_sample_info_t infos_[capacity] = {};
  dds_return_t size_;
};

}  // namespace dripline::dds
