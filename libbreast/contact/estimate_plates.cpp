#include "contact/estimate_plates.hpp"

#include "contact/penetration.hpp"
#include "contact/solvers/raise_friction.hpp"
#include "mechanics/terms/dead_load.hpp"

namespace breast {

namespace {

/// Several terms as one: what an estimate adds to its problem.
class BothTerms final : public Term {
 public:
  BothTerms(std::shared_ptr<const Term> first, std::shared_ptr<const Term> second)
      : first_(std::move(first)), second_(std::move(second)) {}
  std::string name() const override { return first_->name() + " and " + second_->name(); }
  bool add(const State& state, const Request& request, Forces& forces) const override {
    return first_->add(state, request, forces) && second_->add(state, request, forces);
  }
  std::vector<int> nodes() const override { return first_->nodes(); }

 private:
  std::shared_ptr<const Term> first_, second_;
};

/// The forces of the plates on the faces of the richer mesh, where these lie now. They do not change:
/// the nodes that the plates touch are held.
std::shared_ptr<const Term> raise_pressure(const SurfacePressure& coarse, const State& state,
                                           const RicherMesh& richer) {
  SurfacePressure pressure(richer.mesh, touchable_faces(richer.mesh), Discretisation{});
  pressure.set_plates(coarse.plates());
  pressure.set_stiffness(coarse.stiffness());
  const Eigen::VectorXd x = richer.raise(state.x);
  pressure.choose_points(x);
  return std::make_shared<DeadLoad>(pressure.plate_forces(x, 0) + pressure.plate_forces(x, 1));
}

std::vector<TouchingNode> touching_nodes(const ContactSolver& contact, const PlatePair& pair,
                                         const State& state) {
  std::vector<TouchingNode> touching;
  for (std::size_t c = 0; c < contact.candidates().size(); ++c) {
    const int node = contact.candidates()[c], plate = contact.touching()[c];
    if (plate < 0) continue;
    const Gap gap = pair.plate(plate).gap(state.x.segment<3>(3L * node));
    touching.push_back({node, plate, gap.gradient});
  }
  return touching;
}

}  // namespace

ContactEstimate estimate_of_faces(const SurfaceContact& contact, const State& state) {
  ContactEstimate plates;
  plates.touching = touching_nodes(contact, contact.pressure().plates(), state);
  plates.plates = contact.friction();
  plates.raise_plates = [&contact, &state](const RicherMesh& richer) {
    std::shared_ptr<const Term> forces = raise_pressure(contact.pressure(), state, richer);
    if (contact.friction() == nullptr) return forces;
    return std::shared_ptr<const Term>(
        std::make_shared<BothTerms>(std::move(forces), contact.friction()));
  };
  return plates;
}

ContactEstimate estimate_of_nodes(const ContactSolver& contact, const PlatePair& pair,
                                  const std::shared_ptr<FrictionTerm>& friction,
                                  const HexMesh& mesh, const State& state) {
  ContactEstimate plates;
  plates.touching = touching_nodes(contact, pair, state);
  if (friction) {
    plates.plates = friction;
    plates.raise_plates = [friction, &mesh, &state](const RicherMesh& richer) {
      return raise_friction(*friction, mesh, state.x, richer);
    };
  }
  return plates;
}

}  // namespace breast
