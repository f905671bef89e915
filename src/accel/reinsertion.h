// A binary tree made better after it was built.
#pragma once

#include <vector>

#include "accel/binary_tree.h"

namespace trace {

/// Takes large branches out of the tree, one by one, and puts each back where inner boxes grow least
/// (Bittner, Hapala and Havran 2013, Fast insertion-based optimization of bounding volume hierarchies, CGF
/// 32(1)); then smaller ones, as long as it pays. It does where large boxes overlap, as in buildings, but not
/// in scans. Children need not lie behind their parents any more. No item lies deeper than
/// BvhNode::kMostDepth.
void reinsertLargeBranches(std::vector<Branch>& tree);

}  // namespace trace
