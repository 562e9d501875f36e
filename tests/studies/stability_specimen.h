#pragma once

#include <perimorph/application/stability_advice.h>

#include <Eigen/Dense>

#include <memory>
#include <optional>
#include <string>

namespace Perimorph::Studies
{
  /// Who carries the energy of a specimen.
  enum class Method
  {
    finite_elements,
    correspondence,         ///< peridynamics alone
    correspondence_coupled, ///< a ball of peridynamics in finite elements
    bond_based,
    bond_based_coupled
  };

  std::string
  method_name(Method method);

  bool
  is_bond_based(Method method);

  /// One point of the study.
  struct Combination
  {
    double horizon_ratio  = 2.;   ///< m [-]
    double perturbation   = 0.2;  ///< of the spacing
    double poissons_ratio = 0.25; ///< nu [-]
    /// None: automatic.
    std::optional<Peridynamics::InfluenceFunction> influence;
    double aspect  = 1.; ///< length of the cells over their width [-]
    double grading = 1.; ///< last over first cell along each axis [-]
    double gamma   = 1.; ///< stabilisation [-]
  };

  enum class Shape
  {
    block, ///< 12 x 12 or 4 x 4 x 4 cells, length 1 along x
    beam   ///< depth (and width) 1, length 4 (3D: 3); 6 (4) layers
  };

  enum class Law
  {
    small_strain, ///< linear elastic, E = 1
    finite_strain ///< Hencky, or the prototype microelastic law with bonds
  };

  /// A body in plane strain or 3D with everything to measure it; the boundary
  /// x- (block in Newton's method: y-) is held.
  /// @throws Base::InputError  what the program refuses before a solve
  template <int dim>
  class Specimen
  {
  public:
    Specimen(const Combination &combination,
             Method             method,
             Shape              shape,
             Law                law);

    const Mesh::NodalMesh<dim> &
    mesh() const
    {
      return distributed_mesh->nodal();
    }

    Application::CellShapes
    cell_shapes() const;

    /// What the program would say before a solve.
    std::vector<std::string>
    warnings() const;

    /// The affine patch test.
    double
    ghost_force() const;

    /// Tangent at a displacement, all unknowns.
    Eigen::MatrixXd
    tangent(const Fem::Vector &displacement) const;
    Eigen::MatrixXd
    stiffness() const;

    /// Unknowns that the boundary x- does not hold.
    std::vector<unsigned int>
    free_unknowns() const;

    /// Tip deflection in pure bending over the exact one, small strain: exact
    /// displacements at x-, exact tractions at x+.
    double
    bending_ratio() const;

    /// What Newton's method did with the block whose top (y+) is moved.
    struct NewtonOutcome
    {
      unsigned int iterations = 0;
      std::string  failure; ///< empty: converged
      bool stable = false;  ///< tangent positive definite in the last state
    };

    /// @param stretch  final displacement of the top over the height
    /// @param n_steps  equal load steps, none is cut
    NewtonOutcome
    move_top(double stretch, unsigned int n_steps) const;

    /// |v - S v| / |v| of a field on the free unknowns, S being the mean over
    /// the nodes of the cells around a node, |.| weighted by volume.
    double
    roughness(const Eigen::VectorXd           &field,
              const std::vector<unsigned int> &unknowns) const;

  private:
    void
    make_mesh();
    void
    make_region();

    Combination                                    combination;
    Coupling::CouplingParameters                   parameters;
    bool                                           finite_strain;
    Method                                         method;
    Shape                                          shape;
    dealii::Tensor<1, dim>                         size;
    std::unique_ptr<Mesh::DistributedMesh<dim>>    distributed_mesh;
    Mesh::RegionMap                                region;
    Coupling::BodyMaterials<dim>                   materials;
    std::unique_ptr<Coupling::CoupledProblem<dim>> problem;
  };

  /// What finite elements do in the place of peridynamics.
  struct Reference
  {
    Eigen::MatrixXd stiffness; ///< of the free unknowns
    double          frequency; ///< lowest, squared
    double          rough;     ///< roughness of its mode
    double          bending;   ///< Specimen::bending_ratio()
  };

  /// @throws Base::InputError  a mesh that the program refuses
  template <int dim>
  Reference
  finite_element_reference(const Combination &combination);

  /// Eigenvalues of a specimen's stiffness beside those of finite elements.
  struct Spectrum
  {
    double softest = 0.; ///< lowest squared frequency over that of FE
    double worst   = 0.; ///< smallest v.Kv / v.K_FE v of all fields v
    double largest = 0.; ///< largest  v.Kv / v.K_FE v
    double rough   = 0.; ///< roughness of the mode of lowest frequency
  };

  template <int dim>
  Spectrum
  spectrum(const Specimen<dim> &specimen, const Reference &elements);
} // namespace Perimorph::Studies
