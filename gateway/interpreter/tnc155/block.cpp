#include "gateway/interpreter/tnc155/block.hpp"

namespace dripline::interpreter::tnc155 {

const Block kEmptyBlock{};

}  // namespace dripline::interpreter::tnc155
