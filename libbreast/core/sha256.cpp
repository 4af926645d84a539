// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sha256.hpp"

// The functions of OpenSSL 1.1: those of 3 look for a provider first, which reads files and may fail.
#define OPENSSL_API_COMPAT 0x10100000L
#include <openssl/sha.h>

namespace breast {

Sha256::Sha256() : state_(std::make_unique<SHA256_CTX>()) {
  SHA256_Init(state_.get());
}

Sha256::~Sha256() = default;

void Sha256::update(const void* data, std::size_t size) {
  SHA256_Update(state_.get(), data, size);
}

std::string Sha256::hex() {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256_Final(digest, state_.get());
  std::string out;
  for (const unsigned byte : digest) {
    out += "0123456789abcdef"[byte >> 4];
    out += "0123456789abcdef"[byte & 15];
  }
  return out;
}

}  // namespace breast
