// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include "distributed/mesh_part.hpp"
#include "distributed/petsc.hpp"

namespace breast {

namespace {

struct Side4 {
  std::array<int, 4> nodes;
  int element;
  bool operator<(const Side4& other) const { return nodes < other.nodes; }
};

// Graph of the elements that share a face.
std::vector<std::pair<int, int>> neighbours(const HexTopology& mesh) {
  std::vector<Side4> sides;
  sides.reserve(std::size_t(mesh.elements()) * 6);
  for (int e = 0; e < mesh.elements(); ++e) {
    for (const auto& corners : hex_face_corners) {
      Side4 side{{}, e};
      for (int i = 0; i < 4; ++i) side.nodes[i] = mesh.element(e)[corners[i]];
      std::sort(side.nodes.begin(), side.nodes.end());
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].nodes != sides[i - 1].nodes) continue;
    pairs.emplace_back(sides[i].element, sides[i - 1].element);
    pairs.emplace_back(sides[i - 1].element, sides[i].element);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// PETSc takes the arrays and frees them.
PetscInt* petsc_array(std::size_t count) {
  PetscInt* array = nullptr;
  ask(PetscMalloc(std::max<std::size_t>(1, count) * sizeof(PetscInt), &array));
  return array;
}

}  // namespace

std::vector<int> partition(const HexTopology& mesh, int parts) {
  const int count = mesh.elements();
  if (parts == 1) return std::vector<int>(std::size_t(count), 0);
  const auto pairs = neighbours(mesh);
  PetscInt* start = petsc_array(std::size_t(count) + 1);
  PetscInt* other = petsc_array(pairs.size());
  std::fill(start, start + count + 1, 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ++start[pairs[i].first + 1];
    other[i] = pairs[i].second;
  }
  for (int e = 0; e < count; ++e) start[e + 1] += start[e];
  OwnedMat graph;
  ask(MatCreateMPIAdj(PETSC_COMM_SELF, count, count, start, other, nullptr, graph.fresh()));
  Owned<MatPartitioning, MatPartitioningDestroy> cut;
  ask(MatPartitioningCreate(PETSC_COMM_SELF, cut.fresh()));
  ask(MatPartitioningSetAdjacency(cut, graph));
  ask(MatPartitioningSetType(cut, MATPARTITIONINGPTSCOTCH));
  ask(MatPartitioningSetNParts(cut, parts));
  Owned<IS, ISDestroy> found;
  ask(MatPartitioningApply(cut, found.fresh()));
  const PetscInt* part = nullptr;
  ask(ISGetIndices(found, &part));
  std::vector<int> of(part, part + count);
  ask(ISRestoreIndices(found, &part));
  return of;
}

}  // namespace breast
