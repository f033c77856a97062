#pragma once

#include "storage/impl/connections.hpp"
#include "storage/programs/search_store.hpp"

namespace dripline::storage {

class SearchRepository final : public SearchStore {
 public:
  explicit SearchRepository(Connections& connections) : connections_(connections) {}

  Result<std::vector<SearchHit>> search(const std::vector<SearchTerm>& terms,
                                        const SearchFilter& filter, std::uint64_t before,
                                        std::uint64_t limit) override;
  Result<std::uint64_t> count_due() override;
  Result<IndexProgress> index_some() override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
