// Ghosts: objects that are not selected are drawn pale, and clicks pass through them.
import { flag } from "./part";

export const GHOSTS = flag("ghosts", "ghost the others");
