// The poncho in Bullet's btSoftBody over the same figure as 12 convex hulls, in the fastest setting
// found that holds: with fewer iterations, less friction or softer bending links it slips through
// its own neck hole. The world is ten times life size, or Bullet's margins swallow the cloth.
#if __has_include(<BulletSoftBody/btSoftBody.h>)
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <vector>

#include "peers.h"

static const btScalar scale = 10, gravity = btScalar(-9.81) * scale;
enum { ITERATIONS = 30 };

static btVector3 large(const v3 &p)
{
	return btVector3(p.x, p.y, p.z) * scale;
}

// Points of both spheres; their hull is the capsule within 2 %.
static std::unique_ptr<btConvexHullShape> hull_of(const capsule &c)
{
	auto hull = std::make_unique<btConvexHullShape>();
	for (int i = 0; i < 96; i++) {
		btScalar y = 1 - btScalar(2 * i + 1) / 96, r = std::sqrt(1 - y * y);
		btScalar angle = btScalar(2.399963) * btScalar(i);
		btVector3 way(r * std::cos(angle), y, r * std::sin(angle));
		hull->addPoint(large(c.a_m) + way * c.a_radius_m * scale, false);
		hull->addPoint(large(c.b_m) + way * c.b_radius_m * scale, false);
	}
	hull->recalcLocalAabb();
	hull->setMargin(btScalar(0.004) * scale);
	return hull;
}

struct scene {
	btSoftBodyRigidBodyCollisionConfiguration configuration;
	btCollisionDispatcher dispatcher{&configuration};
	btDbvtBroadphase broadphase;
	btSequentialImpulseConstraintSolver solver;
	btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
	std::vector<std::unique_ptr<btConvexHullShape>> shape;
	std::vector<std::unique_ptr<btRigidBody>> rigid;
	std::unique_ptr<btSoftBody> soft;

	~scene()
	{
		world.removeSoftBody(soft.get());
		for (auto &body : rigid)
			world.removeRigidBody(body.get());
	}
};

static void add_body(scene &s, const peers_body &body)
{
	s.world.setGravity(btVector3(0, gravity, 0));
	btSoftBodyWorldInfo &info = s.world.getWorldInfo();
	info.m_gravity = btVector3(0, gravity, 0);
	info.m_sparsesdf.Reset();
	info.m_sparsesdf.setDefaultVoxelsz(btScalar(0.25)); // counts only after Reset
	for (int i = 0; i < body.capsule_count; i++) {
		s.shape.push_back(hull_of(body.capsule[i]));
		s.rigid.push_back(std::make_unique<btRigidBody>(
			btRigidBody::btRigidBodyConstructionInfo(0, nullptr, s.shape.back().get())));
		s.rigid.back()->setFriction(1);
		s.world.addRigidBody(s.rigid.back().get());
	}
}

static void add_cloth(scene &s, const peers_cloth &cloth)
{
	std::vector<btScalar> point;
	std::vector<int> corner;
	for (int v = 0; v < cloth.vertex_count; v++)
		for (int k = 0; k < 3; k++)
			point.push_back(large(cloth.position_m[v])[k]);
	for (int t = 0; t < cloth.triangle_count; t++)
		corner.insert(corner.end(), cloth.triangle[t].v, cloth.triangle[t].v + 3);
	s.soft.reset(btSoftBodyHelpers::CreateFromTriMesh(s.world.getWorldInfo(), point.data(),
							  corner.data(), cloth.triangle_count,
							  false));
	btSoftBody &soft = *s.soft;
	btSoftBody::Material *bend = soft.appendMaterial();
	bend->m_kLST = 1;
	bend->m_flags = 0;
	soft.generateBendingConstraints(2, bend);
	soft.m_materials[0]->m_kLST = 1;
	soft.m_cfg.piterations = ITERATIONS;
	soft.m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
	soft.m_cfg.kKHR = 1; // hardness against static bodies; 0.1 lets the cloth sink in
	soft.m_cfg.kDF = 1;
	soft.m_cfg.kDP = btScalar(0.02);
	soft.getCollisionShape()->setMargin(btScalar(0.004) * scale);
	soft.setTotalMass(btScalar(0.3));
	s.world.addSoftBody(&soft);
}

bool peer_bullet_drape(const peers_body *body, peers_cloth *cloth, drape *drape)
{
	auto s = std::make_unique<scene>();
	add_body(*s, *body);
	add_cloth(*s, *cloth);
	for (int frame = 0; frame < DRAPE_FRAMES; frame++) {
		double start = peers_ms();
		s->world.stepSimulation(btScalar(1) / 60, 1, btScalar(1) / 60);
		s->world.getWorldInfo().m_sparsesdf.GarbageCollect();
		drape->ms[frame] = peers_ms() - start;
	}
	for (int v = 0; v < cloth->vertex_count; v++) {
		btVector3 p = s->soft->m_nodes[v].m_x / scale;
		cloth->position_m[v] = {float(p.x()), float(p.y()), float(p.z())};
	}
	return true;
}
#else
#include "peers.h"

bool peer_bullet_drape(const peers_body *, peers_cloth *, drape *)
{
	return false;
}
#endif
