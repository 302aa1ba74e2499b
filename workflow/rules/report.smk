# What only the report needs: tables as pages, where the results come from, and the numbers in short.


rule tabulate_key_numbers:
    input:
        trajectories="results/tables/trajectories.csv",
        regimes="results/tables/regimes.csv",
        reconstruction="results/tables/reconstruction.csv",
        baselines="results/tables/baselines.csv",
        lags="results/tables/lags.csv",
    output:
        "results/tables/key_numbers.csv",
    log:
        "results/logs/tabulate_key_numbers.log",
    benchmark:
        "results/benchmarks/tabulate_key_numbers.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("tabulate_key_numbers"),
        model=FORECAST_MODEL,
        variant=NODES[FORECAST_MODEL]["variant"],
        angle_index=STUDY.shown_fall[1],
    message:
        "tabulate this run beside the source's claims"
    shell:
        "sedfiber tabulate_key_numbers --trajectories {input.trajectories} --regimes {input.regimes}"
        " --reconstruction {input.reconstruction} --baselines {input.baselines} --lags {input.lags}"
        " --model {params.model} --variant {params.variant} --angle-index {params.angle_index}"
        " -o {output} > {log} 2>&1"


rule show_table:
    input:
        table="results/tables/{table}.csv",
    output:
        report(
            "results/report/{table}.html",
            caption="../report/tables.rst",
            category=shown_in,
            labels={"table": "{table}"},
        ),
    log:
        "results/logs/show_table/{table}.log",
    benchmark:
        "results/benchmarks/show_table/{table}.tsv"
    group:
        "pages"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("show_table"),
    message:
        "table {wildcards.table} as a page"
    shell:
        "sedfiber show_table {input.table} -o {output} > {log} 2>&1"


rule show_manifest:
    input:
        manifest="results/manifest.json",
    output:
        report(
            "results/report/provenance/manifest.html",
            caption="../report/provenance.rst",
            category=PROVENANCE,
            labels={"table": "provenance"},
        ),
    log:
        "results/logs/show_manifest.log",
    benchmark:
        "results/benchmarks/show_manifest.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("show_manifest"),
    message:
        "provenance as a page"
    shell:
        "sedfiber show_manifest {input.manifest} -o {output} > {log} 2>&1"
