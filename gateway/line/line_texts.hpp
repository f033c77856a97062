#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/line/inbound/rule_set.hpp"
#include "gateway/line/line_examination.hpp"
#include "protocol/base/result.hpp"

/// What a server and a gateway beside a control exchange as JSON about the gateway's line. Decoding
/// is strict. Errors of decoding: Syntax.
namespace dripline::line {

/// A text that is to be sent into a control's memory, once all of it has come.
struct TransferOrder {
  std::string content;                ///< its SHA-256, hexadecimal
  std::string name;                   ///< for protocols that carry one
  std::vector<std::string> programs;  ///< what it consists of, for people
};

std::string encode(const TransferOrder& order);
std::string encode(const PortTest& test);
/// At most so many bytes: what was tried last is left out first.
std::string encode(const RuleVerdict& verdict, std::size_t max_bytes);
Result<TransferOrder> decode_transfer_order(std::string_view text);
Result<PortTest> decode_port_test(std::string_view text);
Result<RuleVerdict> decode_rule_verdict(std::string_view text);

}  // namespace dripline::line
