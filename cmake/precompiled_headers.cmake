# The stable, heavy headers, precompiled once and shared by all targets with the
# flags of perimorph_setup_target. Only a saving of time: every file includes
# what it uses and compiles with -D PERIMORPH_PRECOMPILED_HEADERS=OFF too.
if(PERIMORPH_PRECOMPILED_HEADERS)
  target_precompile_headers(perimorph_core PRIVATE
    <deal.II/base/conditional_ostream.h>
    <deal.II/base/function_parser.h>
    <deal.II/base/index_set.h>
    <deal.II/base/mpi.h>
    <deal.II/base/parameter_handler.h>
    <deal.II/base/quadrature_lib.h>
    <deal.II/base/symmetric_tensor.h>
    <deal.II/base/timer.h>
    <deal.II/base/utilities.h>
    <deal.II/distributed/shared_tria.h>
    <deal.II/dofs/dof_handler.h>
    <deal.II/dofs/dof_tools.h>
    <deal.II/fe/fe_q.h>
    <deal.II/fe/fe_system.h>
    <deal.II/fe/fe_values.h>
    <deal.II/grid/grid_generator.h>
    <deal.II/grid/grid_in.h>
    <deal.II/grid/grid_tools.h>
    <deal.II/lac/affine_constraints.h>
    <deal.II/lac/dynamic_sparsity_pattern.h>
    <deal.II/lac/full_matrix.h>
    <deal.II/lac/la_parallel_vector.h>
    <deal.II/lac/trilinos_precondition.h>
    <deal.II/lac/trilinos_solver.h>
    <deal.II/lac/trilinos_sparse_matrix.h>
    <deal.II/lac/trilinos_sparsity_pattern.h>
    <deal.II/lac/trilinos_vector.h>
    <deal.II/meshworker/mesh_loop.h>
    <deal.II/numerics/data_out.h>
    <deal.II/numerics/vector_tools.h>
  )
endif()

# perimorph_reuse_precompiled_headers(<target>): those of perimorph_core.
function(perimorph_reuse_precompiled_headers target)
  if(PERIMORPH_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM perimorph_core)
  endif()
endfunction()
