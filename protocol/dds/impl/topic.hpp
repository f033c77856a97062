#pragma once

#include <dds/dds.h>
#include <dripline.h>  // generated from dripline.idl

#include "protocol/dds/message.hpp"

/// The generated type and the topic name of each message.
namespace dripline::dds {

template <class Message>
struct Topic;
template <class Sample>
struct MessageOfSample;

#define DRIPLINE_TOPIC(Message)                                                                 \
  template <>                                                                                   \
  struct Topic<Message> {                                                                       \
    using Sample = dripline_idl_##Message;                                                      \
    static constexpr const char* kName = "dripline_" #Message;                                  \
    static const dds_topic_descriptor_t& descriptor() { return dripline_idl_##Message##_desc; } \
  };                                                                                            \
  template <>                                                                                   \
  struct MessageOfSample<dripline_idl_##Message> {                                              \
    using Type = Message;                                                                       \
  }

DRIPLINE_TOPIC(Announce);
DRIPLINE_TOPIC(Status);
DRIPLINE_TOPIC(Record);
DRIPLINE_TOPIC(RecordAck);
DRIPLINE_TOPIC(Command);
DRIPLINE_TOPIC(CommandResult);
DRIPLINE_TOPIC(BlockRequest);
DRIPLINE_TOPIC(BlockData);
DRIPLINE_TOPIC(LineRequest);
DRIPLINE_TOPIC(LineData);
#undef DRIPLINE_TOPIC

template <class Message>
using SampleOf = typename Topic<Message>::Sample;
template <class Sample>
using MessageOf = typename MessageOfSample<Sample>::Type;

}  // namespace dripline::dds
