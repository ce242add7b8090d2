#pragma once

namespace vspring {

/// How the normal of a node follows from the nodes around it (§4.2).
enum class PseudoNormals {
  link,     ///< Max's weights around the link: exact on spheres, isotropic on quads
  average,  ///< plain average of the unit normals of the adjoining faces, as in the paper
  area,     ///< weighted by the areas of the faces
  angle     ///< weighted by the angles of the faces at the node
};

/// Where the tangential regularisation (§4.4) sends a node.
enum class Distribution {
  even,  ///< to the mean of its neighbours, as in the paper
  keep   ///< to the share between its neighbours that it has in the input
};

}  // namespace vspring
