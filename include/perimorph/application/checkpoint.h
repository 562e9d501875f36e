#pragma once

#include <perimorph/bonds/broken_bonds.h>
#include <perimorph/bonds/crack_set.h>
#include <perimorph/mesh/distributed_mesh.h>
#include <perimorph/output/checkpoint.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace Perimorph::Base
{
  class InputErrorCollector;
}

namespace Perimorph::Application
{
  /// The file in an output folder.
  std::string
  checkpoint_file(const std::string &folder);

  /// Keeps all entries of a parameter file in a checkpoint.
  void
  store_parameters(const dealii::ParameterHandler &prm,
                   Output::Checkpoint             &checkpoint);

  /// All entries must have the values of the run that is continued, but for
  /// those that say where and whether files are written. Numbers may be written
  /// in another way. Each difference becomes a message.
  /// @param file  of the checkpoint, for the messages
  void
  compare_parameters(const dealii::ParameterHandler &prm,
                     const Output::Checkpoint       &checkpoint,
                     const std::string              &file,
                     Base::InputErrorCollector      &errors);

  /// Keeps what tells meshes apart: numbers of nodes and cells, names of
  /// groups, a checksum of places, cells and groups.
  template <int dim>
  void
  store_mesh(const Mesh::DistributedMesh<dim> &mesh,
             Output::Checkpoint               &checkpoint);

  /// @throws Base::InputError   another mesh than that of the checkpoint
  template <int dim>
  void
  compare_mesh(const Mesh::DistributedMesh<dim> &mesh,
               const std::string                &mesh_file,
               const Output::Checkpoint         &checkpoint,
               const std::string                &file);

  /// Values of nodes in the order of the mesh file, whatever the number of
  /// ranks: dim numbers per node, or one.
  template <int dim>
  std::vector<double>
  in_file_order(const Mesh::DistributedMesh<dim>          &mesh,
                const std::vector<dealii::Tensor<1, dim>> &values);
  template <int dim>
  std::vector<double>
  in_file_order(const Mesh::DistributedMesh<dim> &mesh,
                const std::vector<double>        &values);

  /// The way back, to the order of this run.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  vectors_from_file_order(const Mesh::DistributedMesh<dim> &mesh,
                          const std::vector<double>        &numbers);
  template <int dim>
  std::vector<double>
  from_file_order(const Mesh::DistributedMesh<dim> &mesh,
                  const std::vector<double>        &numbers);

  /// The facets that cracks have grown by; those there from the start are made
  /// from the parameters.
  template <int dim>
  void
  store_advances(const Bonds::CrackSet<dim> &cracks,
                 Output::Checkpoint         &checkpoint);
  template <int dim>
  std::vector<Bonds::CrackFacet<dim>>
  stored_advances(const Output::Checkpoint &checkpoint);

  /// Components of the points one after another.
  template <int dim>
  void
  store_points(const std::vector<dealii::Point<dim>> &points,
               std::vector<double>                   &numbers);
  template <int dim>
  std::vector<dealii::Point<dim>>
  stored_points(const std::vector<double> &numbers);

  /// Bonds that broke one by one, with nodes as in the mesh file.
  template <int dim>
  void
  store_broken_bonds(const Mesh::DistributedMesh<dim> &mesh,
                     const Bonds::BrokenBonds         &broken,
                     Output::Checkpoint               &checkpoint);
  template <int dim>
  Bonds::BrokenBonds
  stored_broken_bonds(const Mesh::DistributedMesh<dim> &mesh,
                      const Output::Checkpoint         &checkpoint);
} // namespace Perimorph::Application
