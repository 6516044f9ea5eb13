// Questions to the program, each one function. What goes wrong is told in the program's own words.
import type { ExportAnswer, LibraryRules, PlaceAnswer, Problem, Project, Vec3, WhyAnswer } from "./types";
import { readSurfaces, type Surfaces } from "./surfaces";

export class ApiError extends Error {
  constructor(message: string, readonly status: number, readonly body: Record<string, unknown>) {
    super(message);
  }
}

async function ask<T>(address: string, body?: unknown, signal?: AbortSignal): Promise<T> {
  const answer = await fetch(address, {
    method: body === undefined ? "GET" : "POST",
    headers: body === undefined ? {} : { "Content-Type": "application/json" },
    body: body === undefined ? null : JSON.stringify(body),
    signal: signal ?? null,
    cache: "no-store",
  });
  const text = await answer.text();
  let found: Record<string, unknown> = {};
  try {
    found = JSON.parse(text) as Record<string, unknown>;
  } catch {
    if (answer.ok) throw new ApiError(`${address}: the answer is no JSON`, answer.status, {});
  }
  if (!answer.ok) throw new ApiError(String(found["error"] ?? answer.statusText), answer.status, found);
  return found as T;
}

export const askProject = () => ask<Project>("/api/project");
export const askSchema = (kind: "rules" | "scene") => ask<Record<string, unknown>>(`/api/schema/${kind}`);
export const askLibrary = async () => (await ask<{ rules: LibraryRules[] }>("/api/library")).rules;

export const sendEdit = (texts: Record<string, string>, signal: AbortSignal) =>
  ask<{ version: number; problems: Problem[] }>("/api/edit", { texts }, signal);

export const askWhy = (version: number, plant: number, node: number) =>
  ask<WhyAnswer>("/api/why", { version, plant, node });

export type Place =
  | { planting: string; seed: number; at_m: Vec3 }
  | { planting: string; at_m: Vec3 }
  | { camera: string; eye_m: Vec3; target_m: Vec3 };

export const askPlace = (place: Place) => ask<PlaceAnswer>("/api/place", place);

export const sendSave = (file: string, text: string, saved: string) =>
  ask<{ saved: string }>("/api/save", { file, text, saved });

export type ExportWish = { what: "glb" | "vdb" | "skeleton" } | { what: "image"; image: string };

export const askExport = (wish: ExportWish) => ask<ExportAnswer>("/api/export", wish);

export async function askSurfaces(version: number, signal: AbortSignal): Promise<Surfaces> {
  const answer = await fetch(`/api/surfaces?version=${version}`, { signal, cache: "no-store" });
  if (!answer.ok) {
    const body = (await answer.json().catch(() => ({}))) as Record<string, unknown>;
    throw new ApiError(String(body["error"] ?? answer.statusText), answer.status, body);
  }
  return readSurfaces(await answer.arrayBuffer());
}
