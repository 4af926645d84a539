// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/exchange.hpp"

#include <algorithm>
#include <limits>

#include "distributed/petsc.hpp"

namespace breast {

namespace {

std::vector<double> gather(const Eigen::VectorXd& values, const std::vector<int>& nodes,
                           long each) {
  std::vector<double> out;
  out.reserve(nodes.size() * std::size_t(each));
  for (const int node : nodes) {
    for (long i = 0; i < each; ++i) out.push_back(values[node * each + i]);
  }
  return out;
}

void add(const std::vector<double>& from, const std::vector<int>& nodes, long each,
         Eigen::VectorXd& values) {
  std::size_t at = 0;
  for (const int node : nodes) {
    for (long i = 0; i < each; ++i) values[node * each + i] += from[at++];
  }
}

}  // namespace

Exchange::Exchange(const Ranks& ranks, const MeshPart& part) : ranks_(ranks), part_(part) {
  for (const SharedNodes& shared : part.shared) {
    all_.insert(all_.end(), shared.nodes.begin(), shared.nodes.end());
  }
  std::sort(all_.begin(), all_.end());
  all_.erase(std::unique(all_.begin(), all_.end()), all_.end());
}

int Exchange::first_element(int mine) const {
  const long none = std::numeric_limits<int>::max();
  const long least = ranks_.least(mine >= 0 ? long(part_.elements[std::size_t(mine)]) : none);
  return least == none ? -1 : int(least);
}

double Exchange::dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  const long own = 3L * part_.owned;
  return ranks_.sum(a.head(own).dot(b.head(own)));
}

void Exchange::complete(Eigen::VectorXd& values) const {
  const long each = values.size() / long(part_.nodes.size());
  const std::size_t others = part_.shared.size();
  std::vector<std::vector<double>> out(others), in(others);
  std::vector<MPI_Request> requests(2 * others);
  for (std::size_t i = 0; i < others; ++i) {
    const SharedNodes& shared = part_.shared[i];
    out[i] = gather(values, shared.nodes, each);
    in[i].resize(out[i].size());
    MPI_Irecv(in[i].data(), int(in[i].size()), MPI_DOUBLE, shared.rank, exchange_tag,
              MPI_COMM_WORLD, &requests[2 * i]);
    MPI_Isend(out[i].data(), int(out[i].size()), MPI_DOUBLE, shared.rank, exchange_tag,
              MPI_COMM_WORLD, &requests[2 * i + 1]);
  }
  const std::vector<double> own = gather(values, all_, each);
  for (const int node : all_) values.segment(node * each, each).setZero();
  MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  bool added = false;
  for (std::size_t i = 0; i <= others; ++i) {
    if (!added && (i == others || part_.shared[i].rank > ranks_.rank())) {
      add(own, all_, each, values);
      added = true;
    }
    if (i < others) add(in[i], part_.shared[i].nodes, each, values);
  }
}

void Exchange::from_owner(Eigen::VectorXd& values) const {
  const long each = values.size() / long(part_.nodes.size());
  values.tail(values.size() - part_.owned * each).setZero();
  complete(values);
}

}  // namespace breast
