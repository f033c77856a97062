#include "server/api/certificate.hpp"

#include <openssl/pem.h>
#include <openssl/x509.h>
#include <ctime>
#include <memory>

namespace dripline::api {

Result<UtcTime> certificate_expiry(const std::string& file) {
  const std::unique_ptr<BIO, decltype(&BIO_free)> bio(BIO_new_file(file.c_str(), "r"), &BIO_free);
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(
      bio ? PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr) : nullptr, &X509_free);
  std::tm parts{};
  if (!certificate || ASN1_TIME_to_tm(X509_get0_notAfter(certificate.get()), &parts) != 1)
    return fail(Errc::Io, "certificate {} cannot be read", file);
  return UtcTime(std::chrono::seconds(::timegm(&parts)));
}

}  // namespace dripline::api
