#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

namespace dripline::interpreter::tnc155 {

const Block kEmptyBlock{};

}  // namespace dripline::interpreter::tnc155
