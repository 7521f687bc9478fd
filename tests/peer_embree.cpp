// Embree's point query on the same body: plain, and with its radius bounded by what is known.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define HAVE_EMBREE 1
#elif __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#define HAVE_EMBREE 1
#endif

#include "peers.h"

#ifdef HAVE_EMBREE
#include <cmath>
#include <limits>
#include <vector>

struct nearest {
	const peers_body *body;
	float square;
};

static v3 minus(const v3 &a, const v3 &b)
{
	return {a.x - b.x, a.y - b.y, a.z - b.z};
}

static float dot(const v3 &a, const v3 &b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

static v3 mad(const v3 &a, const v3 &b, float s)
{
	return {a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}

// Ericson, Real-Time Collision Detection, 5.1.5.
static v3 nearest_on(const v3 &p, const v3 &a, const v3 &b, const v3 &c)
{
	v3 ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
	float d1 = dot(ab, ap), d2 = dot(ac, ap);
	if (d1 <= 0 && d2 <= 0)
		return a;
	v3 bp = minus(p, b);
	float d3 = dot(ab, bp), d4 = dot(ac, bp);
	if (d3 >= 0 && d4 <= d3)
		return b;
	float vc = d1 * d4 - d3 * d2;
	if (vc <= 0 && d1 >= 0 && d3 <= 0)
		return mad(a, ab, d1 / (d1 - d3));
	v3 cp = minus(p, c);
	float d5 = dot(ab, cp), d6 = dot(ac, cp);
	if (d6 >= 0 && d5 <= d6)
		return c;
	float vb = d5 * d2 - d1 * d6;
	if (vb <= 0 && d2 >= 0 && d6 <= 0)
		return mad(a, ac, d2 / (d2 - d6));
	float va = d3 * d6 - d5 * d4;
	if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
		return mad(b, minus(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6)));
	float scale = 1 / (va + vb + vc);
	return mad(mad(a, ab, vb * scale), ac, vc * scale);
}

static bool look(RTCPointQueryFunctionArguments *arguments)
{
	nearest &best = *static_cast<nearest *>(arguments->userPtr);
	const RTCPointQuery &query = *arguments->query;
	const int *v = best.body->triangle[arguments->primID].v;
	const v3 *x = best.body->position_m;
	v3 p = {query.x, query.y, query.z};
	v3 away = minus(p, nearest_on(p, x[v[0]], x[v[1]], x[v[2]]));
	float square = dot(away, away);
	if (square >= best.square)
		return false;
	best.square = square;
	arguments->query->radius = std::sqrt(square);
	return true;
}

static RTCScene make_scene(RTCDevice device, const peers_body &body)
{
	RTCScene scene = rtcNewScene(device);
	RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
	rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
	auto *x = static_cast<v3 *>(rtcSetNewGeometryBuffer(
		geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(v3),
		size_t(body.vertex_count)));
	auto *t = static_cast<triangle *>(rtcSetNewGeometryBuffer(
		geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(triangle),
		size_t(body.triangle_count)));
	for (int v = 0; v < body.vertex_count; v++)
		x[v] = body.position_m[v];
	for (int i = 0; i < body.triangle_count; i++)
		t[i] = body.triangle[i];
	rtcCommitGeometry(geometry);
	rtcAttachGeometry(scene, geometry);
	rtcReleaseGeometry(geometry);
	rtcCommitScene(scene);
	return scene;
}

bool peer_embree_track(const peers_body *body, const v3 *point_m, int count, int frames,
				  bool bounded, float *distance_m, double *ms)
{
	RTCDevice device = rtcNewDevice("threads=1");
	RTCScene scene = make_scene(device, *body);
	std::vector<float> last(size_t(count), std::numeric_limits<float>::infinity());
	*ms = 0;
	for (int frame = 0; frame < frames; frame++) {
		const v3 *now = point_m + size_t(frame) * size_t(count);
		const v3 *before = frame ? now - count : now;
		float *distance = distance_m + size_t(frame) * size_t(count);
		double start = peers_ms();
		for (int i = 0; i < count; i++) {
			v3 step = minus(now[i], before[i]);
			float radius = bounded ? last[size_t(i)] + 1.001f * std::sqrt(dot(step, step)) + 1e-6f
					       : std::numeric_limits<float>::infinity();
			RTCPointQuery query = {now[i].x, now[i].y, now[i].z, 0, radius};
			RTCPointQueryContext context;
			rtcInitPointQueryContext(&context);
			nearest best = {body, radius * radius};
			rtcPointQuery(scene, &query, &context, look, &best);
			distance[i] = last[size_t(i)] = std::sqrt(best.square);
		}
		*ms += frame > 0 ? peers_ms() - start : 0; // the first frame knows nothing
	}
	rtcReleaseScene(scene);
	rtcReleaseDevice(device);
	return true;
}
#else
bool peer_embree_track(const peers_body *, const v3 *, int, int, bool, float *, double *)
{
	return false;
}
#endif
