// VTK's windowed sinc filter, a low-pass filter; the boundary stays. It can hold no other nodes. The variant is the
// number of iterations and the pass band, "100,0.001".

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "driver.hpp"

namespace {

using namespace vspring;

vtkNew<vtkPolyData> surface_of(const PolygonMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vector3& p : mesh.positions()) points->InsertNextPoint(p.data());
  vtkNew<vtkCellArray> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const std::vector<vtkIdType> nodes(face.begin(), face.end());
    faces->InsertNextCell(static_cast<vtkIdType>(nodes.size()), nodes.data());
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(faces);
  return surface;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::drive(argc, argv, [](const PolygonMesh& mesh, int, const std::string& variant, bench::Cost& cost) {
    const vtkNew<vtkPolyData> surface = surface_of(mesh);
    vtkNew<vtkWindowedSincPolyDataFilter> filter;
    filter->SetInputData(surface);
    filter->SetNumberOfIterations(std::atoi(variant.c_str()));
    filter->SetPassBand(std::stod(variant.substr(variant.find(',') + 1)));
    filter->BoundarySmoothingOff();
    filter->FeatureEdgeSmoothingOff();
    filter->NonManifoldSmoothingOff();
    filter->NormalizeCoordinatesOn();
    cost = bench::measure([&] { filter->Update(); });
    std::vector<Vector3> positions(static_cast<std::size_t>(mesh.node_count()));
    for (Index i = 0; i < mesh.node_count(); ++i)
      filter->GetOutput()->GetPoint(i, positions[static_cast<std::size_t>(i)].data());
    return positions;
  });
}
