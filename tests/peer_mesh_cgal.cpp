// The same outline as bench_mesh's shirt front, meshed by CGAL's Mesh_2: what others need for it.
// Built by `make bench-peer` alone; needs libcgal-dev.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

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

static void bench(double size)
{
	std::vector<double> ms;
	int triangles = 0;
	double least = 180, mean = 0;
	for (int repeat = 0; repeat < 9; repeat++) {
		auto start = std::chrono::steady_clock::now();
		Mesh mesh;
		std::vector<Mesh::Vertex_handle> handle;
		for (const auto &point : shirt())
			handle.push_back(mesh.insert(point));
		for (size_t i = 0; i < handle.size(); i++)
			mesh.insert_constraint(handle[i], handle[(i + 1) % handle.size()]);
		CGAL::refine_Delaunay_mesh_2(mesh, Criteria(0.125, size));
		std::chrono::duration<double, std::milli> time =
			std::chrono::steady_clock::now() - start;
		ms.push_back(time.count());
		triangles = 0;
		least = 180;
		mean = 0;
		for (auto face : mesh.finite_face_handles())
			if (face->is_in_domain()) {
				double angle = smallest_angle(face);
				triangles++;
				mean += angle;
				least = std::min(least, angle);
			}
	}
	std::sort(ms.begin(), ms.end());
	std::printf("CGAL Mesh_2, shirt front %5d triangles  median %6.2f ms, least %6.2f  "
		    "smallest angle %4.1f, mean %4.1f\n",
		    triangles, ms[4], ms[0], least, mean / triangles);
}

int main()
{
	for (double size : {36.0, 25.0, 18.0})
		bench(size);
}
