/* The pen's first touch on 10,000 vertices: the drag's graph beside Dijkstra's sum of edges on the
 * same cloth. The tube's distances are known, so that both errors are. */
#include "dress_drag_private.h"
#include "peers_rows.h"
#include "tube.h"

enum { PLACES = 24, ROUNDS = 7, VERTICES = 10000 };

struct queue {
	int count, *at, *heap; /* per vertex: place in the heap, -1: not in it */
	float *distance_m;
};

static void queue_put(struct queue *queue, int at, int v)
{
	queue->heap[at] = v;
	queue->at[v] = at;
}

static void queue_rise(struct queue *queue, int at, int v)
{
	const float *distance_m = queue->distance_m;
	for (; at > 0 && distance_m[v] < distance_m[queue->heap[(at - 1) / 2]]; at = (at - 1) / 2)
		queue_put(queue, at, queue->heap[(at - 1) / 2]);
	queue_put(queue, at, v);
}

static int queue_pop(struct queue *queue)
{
	const float *distance_m = queue->distance_m;
	int top = queue->heap[0], last = queue->heap[--queue->count], at = 0;
	for (int child = 1; child < queue->count; child = 2 * at + 1) {
		if (child + 1 < queue->count &&
		    distance_m[queue->heap[child + 1]] < distance_m[queue->heap[child]])
			child++;
		if (distance_m[last] <= distance_m[queue->heap[child]])
			break;
		queue_put(queue, at, queue->heap[child]);
		at = child;
	}
	queue_put(queue, at, last);
	return top;
}

static void offer(struct queue *queue, int v, float distance_m)
{
	if (distance_m >= queue->distance_m[v])
		return;
	queue->distance_m[v] = distance_m;
	queue_rise(queue, queue->at[v] >= 0 ? queue->at[v] : queue->count++, v);
}

/* The textbook's: from the grabbed triangle's corners over edges as long as the chords between what
 * lies under their ends. */
static void dijkstra(struct queue *queue, const struct drag *drag, struct v3 from_m)
{
	const struct cloth *cloth = drag->cloth;
	for (int v = 0; v < cloth->garment->vertex_count; v++) {
		queue->distance_m[v] = 1e9f;
		queue->at[v] = -1;
	}
	queue->count = 0;
	for (int k = 0; k < 3; k++) {
		int v = cloth->triangle[drag->triangle].v[k];
		offer(queue, v, v3_distance(from_m, cloth->contact[v].point_m));
	}
	while (queue->count > 0) {
		int a = queue_pop(queue);
		struct v3 a_m = cloth->contact[a].point_m;
		for (int i = 2 * cloth->star_first[a]; i < 2 * cloth->star_first[a + 1]; i++) {
			int b = cloth->ring[i];
			offer(queue, b,
			      queue->distance_m[a] + v3_distance(a_m, cloth->contact[b].point_m));
		}
	}
}

struct error {
	double sum, count;
};

static void note(struct error *error, const struct drag *drag, const float *distance_m,
		 struct v3 from_m)
{
	for (int k = 0; k < drag->order_count; k++) {
		int a = drag->order[k];
		double exact = (double)tube_distance(from_m, drag->cloth->contact[a].point_m);
		if (exact < 0.02)
			continue;
		double off = (double)distance_m[a] / exact - 1.0;
		error->sum += off < 0.0 ? -off : off;
		error->count++;
	}
}

/* The dearest of many places, each at the best of some rounds. */
void peers_drag(void)
{
	static const float weight[3] = {0.5f, 0.3f, 0.2f};
	struct scene *scene = scene_open();
	struct session *session = &scene->session;
	struct drag *drag = &session->drag;
	tube_lay(scene, VERTICES);
	size_t count = (size_t)session->garment.vertex_count;
	struct queue queue = {0, malloc(count * sizeof(int)), malloc(count * sizeof(int)),
			      malloc(count * sizeof(float))};
	MUST(queue.at && queue.heap && queue.distance_m);
	struct error own_error = {0}, peer_error = {0};
	double own_ms = 0.0, peer_ms = 0.0;
	for (int place = 0; place < PLACES; place++) {
		int triangle = session->garment.triangle_count * place / PLACES + 7;
		double own_best = 1e9, peer_best = 1e9;
		struct body_hit under;
		for (int round = 0; round < ROUNDS; round++) {
			double start = peers_ms();
			drag_begin(drag, &session->cloth, NULL, 0, triangle, weight);
			double ms = peers_ms() - start;
			own_best = ms < own_best ? ms : own_best;
			body_nearest(&session->body, drag_point(drag), 0, &under);
			start = peers_ms();
			dijkstra(&queue, drag, under.point_m);
			ms = peers_ms() - start;
			peer_best = ms < peer_best ? ms : peer_best;
			drag_end(drag);
		}
		own_ms = own_best > own_ms ? own_best : own_ms;
		peer_ms = peer_best > peer_ms ? peer_best : peer_ms;
		note(&own_error, drag, drag->distance_m, under.point_m);
		note(&peer_error, drag, queue.distance_m, under.point_m);
	}
	const char *peer = "Dijkstra, edges";
	struct peers_row row[] = {
		{"", "ms", LESS, own_ms, 2.0, peer, peer_ms, NO_TARGET},
		{"its distances, off in the mean", "%", LESS,
		 100.0 * own_error.sum / own_error.count, 1.0, peer,
		 100.0 * peer_error.sum / peer_error.count, NO_TARGET},
	};
	snprintf(row[0].what, sizeof row[0].what, "%d vertices: pen-down on a tube, the dearest",
		 session->garment.vertex_count);
	peers_add(&row[0]);
	peers_add(&row[1]);
	free(queue.at);
	free(queue.heap);
	free(queue.distance_m);
	scene_close(scene);
}
