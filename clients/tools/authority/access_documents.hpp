#pragma once

#include <string>

#include "clients/tools/authority/identity.hpp"

/// The two documents of DDS Security, as XML that is signed before it is used. Pure.
namespace dripline::authority {

/// What holds for all: no participant without a certificate, discovery and data encrypted, every
/// reader and writer needs a permission. Packets carry no further signature: the data does, and it
/// would cost half of the throughput.
std::string governance_document();

/// What one holder may do: the server reads what gateways write and writes what they read, of all
/// machines; a gateway the opposite, in the partition of its machine alone.
/// `subject`: as in the certificate (pki::Certificate::subject).
std::string permissions_document(const Holder& holder, const std::string& subject,
                                 const Validity& validity);

}  // namespace dripline::authority
