// The shirt front of bench_mesh, meshed by CGAL's Mesh_2.
#if __has_include(<CGAL/Delaunay_mesher_2.h>)
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "peers.h"

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using Face = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Cells = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Mesh = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Cells>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Mesh>;

static std::vector<Kernel::Point_2> shirt()
{
	static const double corner[10][2] = {{240, -330}, {220, 150},  {330, 120},   {370, 235},
					     {90, 300},   {-90, 300},  {-370, 235},  {-330, 120},
					     {-220, 150}, {-240, -330}};
	std::vector<Kernel::Point_2> outline;
	for (int k = 0; k < 10; k++) {
		outline.emplace_back(corner[k][0], corner[k][1]);
		for (int i = 1; k == 4 && i < 20; i++)
			outline.emplace_back(90 * std::cos(M_PI * i / 20),
					     300 - 60 * std::sin(M_PI * i / 20));
	}
	return outline;
}

static double smallest_angle(const Mesh::Face_handle &face)
{
	double least = 180;
	for (int k = 0; k < 3; k++) {
		auto a = face->vertex(k)->point();
		auto p = face->vertex((k + 1) % 3)->point() - a;
		auto q = face->vertex((k + 2) % 3)->point() - a;
		double cross = p.x() * q.y() - p.y() * q.x();
		least = std::min(least, std::atan2(std::fabs(cross), p * q) * 180 / M_PI);
	}
	return least;
}

// The criterion is an edge length; this one gives about so many triangles on the shirt front.
static double edge_for(int triangles)
{
	const double area = 402000;
	return 1.95 * std::sqrt(area / triangles);
}

bool peer_cgal_mesh(int triangles, mesh_figures *figures)
{
	*figures = {};
	double start = peers_ms();
	Mesh mesh;
	std::vector<Mesh::Vertex_handle> handle;
	for (const auto &point : shirt())
		handle.push_back(mesh.insert(point));
	for (size_t i = 0; i < handle.size(); i++)
		mesh.insert_constraint(handle[i], handle[(i + 1) % handle.size()]);
	CGAL::refine_Delaunay_mesh_2(mesh, Criteria(0.125, edge_for(triangles)));
	figures->ms = peers_ms() - start;
	figures->angle_min_deg = 180;
	for (auto face : mesh.finite_face_handles())
		if (face->is_in_domain()) {
			double angle = smallest_angle(face);
			figures->triangles++;
			figures->angle_mean_deg += angle;
			figures->angle_min_deg = std::min(figures->angle_min_deg, angle);
		}
	figures->angle_mean_deg /= figures->triangles;
	return true;
}
#else
#include "peers.h"

bool peer_cgal_mesh(int, mesh_figures *)
{
	return false;
}
#endif
